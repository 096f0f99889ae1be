// The small symmetric systems of Newton's methods.
#pragma once

#include "core/geometry/types.hpp"

namespace voussoir {

// Solves H y = g by LDLᵀ without pivoting for every column of g, y in its place; false when H is not positive definite.
// Only H's lower half is read. The order of operations is explicit: the same bits for every instruction set.
template <int Size, int Columns = 1>
bool solve_symmetric(FixedMatrix<Size, Size> h, FixedMatrix<Size, Columns>& g) {
  for (int k = 0; k < Size; ++k) {
    if (!(h(k, k) > 0)) return false;
    for (int i = k + 1; i < Size; ++i) {
      const double factor = h(i, k) / h(k, k);
      for (int j = k + 1; j <= i; ++j)
        h(i, j) -= factor * h(j, k);
      g.row(i) -= factor * g.row(k);
    }
  }
  for (int k = Size - 1; k >= 0; --k) {
    for (int i = k + 1; i < Size; ++i)
      g.row(k) -= h(i, k) * g.row(i);
    g.row(k) /= h(k, k);
  }
  return true;
}

// below this decrement² of a self-concordant function a full Newton step stays within its domain (the Dikin ellipsoid)
inline constexpr double full_step_decrement = 1.0 / 16;

}  // namespace voussoir
