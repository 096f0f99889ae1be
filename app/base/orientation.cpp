#include "app/base/orientation.hpp"

#include <limits>

#include "core/geometry/eigen_pairs.hpp"

namespace voussoir {

template <int Dim>
MeanOrientation mean_orientation(const std::vector<Vector<Dim>>& normals) {
  Matrix<Dim> moments = Matrix<Dim>::Zero();
  for (const Vector<Dim>& normal : normals)
    moments += normal * normal.transpose();
  Vector<Dim> mean = eigen_pairs<Dim>(moments).vectors.col(Dim - 1);
  if (mean[Dim - 1] < 0) mean = -mean;
  Vector<Dim> sum = Vector<Dim>::Zero();
  for (const Vector<Dim>& normal : normals)
    sum += normal.dot(mean) < 0 ? Vector<Dim>(-normal) : normal;
  MeanOrientation found{angles_of(mean), {}};
  const auto n = static_cast<double>(normals.size());
  const bool scattered = Dim == 3 && n > 1 && n - sum.norm() > n * std::numeric_limits<double>::epsilon();
  if (scattered) found.fisher_constant = (n - 1) / (n - sum.norm());
  return found;
}

template MeanOrientation mean_orientation<2>(const std::vector<Vector<2>>&);
template MeanOrientation mean_orientation<3>(const std::vector<Vector<3>>&);

}  // namespace voussoir
