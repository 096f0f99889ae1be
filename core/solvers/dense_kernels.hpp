// Dense products in lanes of 16 bytes: plain C, column by column, each sum in the order of its terms and nothing fused,
// so that no bit depends on machine or compiler.
#pragma once

#include <vector>

namespace voussoir {

// y -= factor * x
void subtract_multiple(int count, double factor, const double* x, double* y);

// x · y
double dot_product(int count, const double* x, const double* y);

// C -= A B for matrices by columns, whose columns are `stride` numbers apart. `lower`: only entries on and below C's
// diagonal are wanted; others may change too. `packed` is memory of the caller, used again.
struct DenseView {
  double* at;
  int rows, columns;
  int stride;
};
void subtract_product(const DenseView& a, const DenseView& b, const DenseView& c, bool lower,
                      std::vector<double>& packed);

}  // namespace voussoir
