// The geometry of two overlapping parts: their planes in one frame, the direction between them at a point, how far and
// how wide they overlap. Planes of A are first.
#pragma once

#include <span>
#include <vector>

#include "core/contact/pair.hpp"

namespace voussoir {

// Planes of both parts in the first body's frame, seen from `origin` (Eqs 3.22-3.25, there in the world's).
template <int Dim>
void assemble(const Pair<Dim>& pair, const Vector<Dim>& origin, HalfSpaces<Dim>& planes);

// how much each of these planes counts (Polytope::face_weights); empty: all count 1
template <int Dim>
void assemble_weights(const Pair<Dim>& pair, std::vector<double>& weights);

// of one plane
inline double weight_of(std::span<const double> weights, std::size_t plane) {
  return weights.empty() ? 1 : weights[plane];
}

// Direction from A to B at a point (Eqs 3.31-3.35): difference of the gradients of the parts' inner potentials
// sum w <a·x - d + r>², normalised. False when it vanishes. `fallback` reports that a face normal replaced a zero
// gradient. `weights`: of the planes, from assemble_weights.
template <int Dim>
bool contact_normal(const HalfSpaces<Dim>& planes, int faces_a, const Vector<Dim>& point, double radius,
                    Vector<Dim>& normal, bool& fallback, std::span<const double> weights = {});

// Overlap along the normal (Eq. 3.36) and the two faces that end it; false when the search meets no face.
template <int Dim>
bool overlap_along(const HalfSpaces<Dim>& planes, int faces_a, const Vector<Dim>& point, const Vector<Dim>& normal,
                   double& overlap, int& face_a, int& face_b);

// Area (2-D: length) of the section of the overlap region through the point normal to n, by clipping, not
// by the tracing of Eqs D.1 and D.2. `reach` bounds the section, m.
template <int Dim>
double section_area(const HalfSpaces<Dim>& planes, const Vector<Dim>& point, const Vector<Dim>& normal, double reach);

// The section itself, in axes about the point: perpendicular(n) and, in 3-D, n × perpendicular(n).
struct Segment {
  double low, high;  // m
};
Segment section_segment(const HalfSpaces<2>& planes, const Vector<2>& point, const Vector<2>& normal, double reach);
void section_polygon(const HalfSpaces<3>& planes, const Vector<3>& point, const Vector<3>& normal, double reach,
                     std::vector<Vector<2>>& polygon);

// the part of a convex polygon in {y : q·y <= slack} (Sutherland and Hodgman)
void clip_polygon(const std::vector<Vector<2>>& polygon, const Vector<2>& q, double slack,
                  std::vector<Vector<2>>& clipped);

}  // namespace voussoir
