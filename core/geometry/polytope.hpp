// A convex part: its half-spaces and the data that follow from them. Vertices serve mass, bounds and drawing only;
// slicing and contact work on the half-spaces.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/geometry/half_space.hpp"

namespace voussoir {

template <int Dim>
struct MassProperties {
  double volume = 0;                                // m³ (2-D: m², unit thickness)
  Vector<Dim> centroid = Vector<Dim>::Zero();       // m
  Matrix<Dim> second_moment = Matrix<Dim>::Zero();  // ∫ x xᵀ dV about the origin, m⁵ (2-D: m⁴)
};

// a part as a potential particle: core/potential/particle.hpp
template <int Dim>
struct Particle;

template <int Dim>
struct Polytope {
  HalfSpaces<Dim> faces;                        // body frame, none redundant
  std::vector<int> joints;                      // for each face the joint that made it, or no_joint
  std::vector<Vector<Dim>> vertices;            // body frame, m
  std::vector<std::vector<int>> loops;          // vertices of each face, counter-clockwise seen from outside
  MassProperties<Dim> mass;                     // about the body's origin, per unit density
  double inscribed_radius = 0;                  // Chebyshev radius, m: the size of the part (Eq. 3.18)
  Vector<Dim> centre = Vector<Dim>::Zero();     // its centre, m
  double radius = 0;                            // largest distance of a vertex from the body's origin, m
  std::array<int, Dim + 1> basis{};             // faces that touch the inscribed ball: the LP's start
  FixedMatrix<Dim + 1, Dim + 1> basis_inverse;  // of the columns (normal, 1) of these faces
  double vertex_error = 0;           // m: no point of the half-spaces lies farther outside the vertices' hull than this
  double largest_face = 0;           // area of the largest face, m² (2-D: m)
  std::vector<double> face_weights;  // of facets of one face (facet_weights.hpp); empty: every face counts 1
  // If the part is a potential particle, the faces only enclose it; if it meets potential particles, this is its form
  // in their contacts; else none.
  std::shared_ptr<const Particle<Dim>> particle;
};

// the order of solids, for any order of input: by centroid, then volume
template <int Dim>
bool in_order(const MassProperties<Dim>& a, const MassProperties<Dim>& b) {
  for (int k = 0; k < Dim; ++k)
    if (a.centroid[k] != b.centroid[k]) return a.centroid[k] < b.centroid[k];
  return a.volume < b.volume;
}

// a face that no joint made: the domain's boundary or a block given directly
inline constexpr int no_joint = -1;

// Exact integrals over the solid, summed over simplices around the mean vertex so that nothing depends on the origin.
template <int Dim>
MassProperties<Dim> integrate(const std::vector<Vector<Dim>>& vertices, const std::vector<std::vector<int>>& loops);

// the same mass properties seen from an origin moved by `shift`
template <int Dim>
MassProperties<Dim> moved_origin(const MassProperties<Dim>& mass, const Vector<Dim>& shift);

// How far the half-spaces may reach beyond the hull of the vertices computed from them, m: at a sharp corner the
// rounding of its planes moves it far.
template <int Dim>
double find_vertex_error(const Polytope<Dim>& part);

// the vertices of a part in the plane along its boundary, counter-clockwise
std::vector<int> boundary_ring(const Polytope<2>& part);

// area (2-D: length) of a face by its corners in order around it; 0 without `Dim` of them
template <int Dim>
double face_area(const std::vector<Vector<Dim>>& vertices, const std::vector<int>& loop);
template <int Dim>
double face_area(const Polytope<Dim>& part, int face) {
  return face_area<Dim>(part.vertices, part.loops[face]);
}

// centroid of a face with at least `Dim` corners; of one without area its first corner
template <int Dim>
Vector<Dim> face_centroid(const std::vector<Vector<Dim>>& vertices, const std::vector<int>& loop,
                          const Vector<Dim>& normal);

template <int Dim>
double find_largest_face(const Polytope<Dim>& part);

// the same part seen from an origin moved by `shift`
template <int Dim>
Polytope<Dim> moved_origin(Polytope<Dim> part, const Vector<Dim>& shift);

// tensor of inertia about the origin for unit density: 2-D ∫ (x² + y²), 3-D ∫ (|x|² I - x xᵀ)
Matrix<3> inertia_tensor(const MassProperties<3>& mass);
double inertia_tensor(const MassProperties<2>& mass);

}  // namespace voussoir
