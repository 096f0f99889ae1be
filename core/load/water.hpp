// Water on blocks: a pressure p = γ max(0, h(x) - z) on their faces in the current position, z being the last
// coordinate. The water is static: no flow, no drag, no added mass. Every integral is exact up to rounding. All results
// are those of a unit weight γ of 1 N/m³; lengths in m, in one frame.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "core/geometry/polytope.hpp"
#include "core/load/load.hpp"

namespace voussoir {

// A stretch in which the surface of a water is a plane: rise·(point - x) is the depth h(x) - z of a point x below it.
template <int Dim>
struct WaterStretch {
  double from = -std::numeric_limits<double>::infinity();  // m, along x: in the plane alone, in space there is one
  double to = std::numeric_limits<double>::infinity();
  Vector<Dim> point = Vector<Dim>::Zero();        // of the surface
  Vector<Dim> rise = Vector<Dim>::Unit(Dim - 1);  // up - ∇h
};

// The stretches of a surface from its numbers. In the plane points x0, h0, x1, h1, … of ascending x, straight between
// them and constant beyond; in space h at the origin, ∂h/∂x, ∂h/∂y.
template <int Dim>
void list_stretches(std::span<const double> numbers, std::vector<WaterStretch<Dim>>& stretches);

// the pose of a body: its parts are in its frame, whose origin is its centroid
template <int Dim>
struct Standing {
  Vector<Dim> centroid = Vector<Dim>::Zero();
  Matrix<Dim> axes = Matrix<Dim>::Identity();
};

// The part of a body below the surface, moments about the body's centroid.
template <int Dim>
struct Submerged {
  double volume = 0;                               // m³ (2-D: m²)
  Vector<Dim> first_moment = Vector<Dim>::Zero();  // ∫ r dV, m⁴
  double potential = 0;                            // ∫ (h - z) dV, m⁴
  Load<Dim> load;                                  // V rise of each stretch, at the centroid of the piece within it
};

// Volume form, for a surface that wets every face: the pressures' resultant is that of their gradient over the volume
// below the surface, whose pieces are cut at the borders of the stretches (the forces on these cuts cancel). The load
// is minus the gradient of the potential. `radius`: the largest distance of a vertex from the body's centroid: bodies
// entirely below the surface or above it are not cut.
template <int Dim>
Submerged<Dim> submerged(const std::vector<Polytope<Dim>>& parts, double radius, const Standing<Dim>& standing,
                         std::span<const WaterStretch<Dim>> surface);

// One face: force and moment about the body's centroid of the pressure below a surface, or of 1 Pa all over it.
template <int Dim>
Load<Dim> pressure_on_face(const Polytope<Dim>& part, std::size_t face, const Standing<Dim>& standing,
                           std::span<const WaterStretch<Dim>> surface);
template <int Dim>
Load<Dim> uniform_pressure_on_face(const Polytope<Dim>& part, std::size_t face, const Matrix<Dim>& axes);

// the greatest depth that any point of a ball of this radius about the centroid may have; negative: it is dry
template <int Dim>
double greatest_depth(const Vector<Dim>& centroid, double radius, std::span<const WaterStretch<Dim>> surface);

// Upper bound of the total change of the pressure gradient: that of the steepest stretch, which ends at the
// surface, and the bends between stretches, N/m³ at 1 N/m³.
template <int Dim>
double steepness(std::span<const WaterStretch<Dim>> surface);

// Upper bounds of the derivative of a water's load by the pose of a body, at any pose, for a steepness of 1 N/m³. A
// section of a convex part is at most half of its surface: translation with the section, rotation with its second
// moment and with the lever of the buoyancy.
template <int Dim>
BodyStiffness greatest_water_stiffness(const std::vector<Polytope<Dim>>& parts, double radius);

// m² (2-D: m): of all faces of all parts
template <int Dim>
double surface_area(const std::vector<Polytope<Dim>>& parts);

}  // namespace voussoir
