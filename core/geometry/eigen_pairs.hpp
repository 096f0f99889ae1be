// The one place that instantiates Eigen's solver of symmetric matrices, which costs the compiler seconds per source.
#pragma once

#include "core/geometry/types.hpp"

namespace voussoir {

template <int Dim>
struct EigenPairs {
  Vector<Dim> values;   // ascending
  Matrix<Dim> vectors;  // columns of length 1
};

// of a symmetric matrix, of which only the lower triangle is read
template <int Dim>
EigenPairs<Dim> eigen_pairs(const Matrix<Dim>& symmetric);

}  // namespace voussoir
