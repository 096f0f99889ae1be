// Boundary stress: forces on the faces that no joint made.
#pragma once

#include <vector>

#include "core/geometry/polytope.hpp"
#include "core/load/load.hpp"

namespace voussoir {

// The forces of a stress (Pa, compression positive, world axes) on the faces of an unturned part that no joint made:
// -stress n A at the centroid of each, n its outward normal. Faces that it does not load are left out.
template <int Dim>
std::vector<DeadLoad<Dim>> boundary_loads(const Polytope<Dim>& part, const Matrix<Dim>& stress);

// A stress that grows with depth, Pa, compression positive, world axes.
template <int Dim>
struct DepthStress {
  Matrix<Dim> above = Matrix<Dim>::Zero();      // at and above the surface
  Matrix<Dim> per_depth = Matrix<Dim>::Zero();  // Pa/m: increase with depth below it
  double surface = 0;                           // m: its elevation, in the part's coordinates

  Matrix<Dim> at(const Vector<Dim>& point) const;
};

// The forces of such a stress, at as many points of each face as give its force and its moment exactly. A face that the
// surface crosses is cut there, since the stress is linear only on either side of it.
template <int Dim>
std::vector<DeadLoad<Dim>> boundary_loads(const Polytope<Dim>& part, const DepthStress<Dim>& stress);

// a symmetric tensor from its components: 2-D xx, yy, xy; 3-D xx, yy, zz, yz, zx, xy
Matrix<2> stress_tensor_2d(const std::vector<double>& components);
Matrix<3> stress_tensor_3d(const std::vector<double>& components);

template <int Dim>
Matrix<Dim> stress_tensor(const std::vector<double>& components) {
  if constexpr (Dim == 2)
    return stress_tensor_2d(components);
  else
    return stress_tensor_3d(components);
}

}  // namespace voussoir
