// Contact between two convex parts (Boon 2013, chapter 3.3): do they overlap, where, in which direction, how far, how
// wide.
#pragma once

#include <span>

#include "core/contact/contact.hpp"
#include "core/geometry/polytope.hpp"
#include "core/optimise/solvers.hpp"
#include "core/settings.hpp"

namespace voussoir {

// how far a pair is resolved; each stage contains those before it
enum class Stage {
  decision,  // touching or not, and what proves it
  point,     // and where
  overlap,   // and in which direction, how far, between which faces
  area       // and how wide
};

// Two parts as the first one sees them. Positions were subtracted before, so nothing depends on where the pair lies.
template <int Dim>
struct Pair {
  const Polytope<Dim>* a = nullptr;
  const Polytope<Dim>* b = nullptr;
  Matrix<Dim> axes;      // frame of the first body -> world
  Matrix<Dim> rotation;  // frame of the second body -> frame of the first
  Vector<Dim> offset;    // centroid of the second body in the frame of the first, m
  Stage last = Stage::area;
};

// work done by the kernel, summed into the state's counters
struct KernelCounters {
  long long evaluations = 0;   // pairs looked at
  long long motion_skips = 0;  // not even looked at: too far apart for what the bodies moved (core/stages)
  long long axis_hits = 0;     // still separated by the axis of the step before
  long long point_hits = 0;    // still touching at the point of the step before
  long long cold_starts = 0;   // resolved from nothing
  long long undecided = 0;     // nearer to touching than rounding can tell
  long long lp_solves = 0;
  long long lp_pivots = 0;
  long long newton_iterations = 0;
  long long centre_fallbacks = 0;  // Newton failed, Ipopt answered
  long long areas = 0;
  long long normal_fallbacks = 0;  // normals taken from a face or from the LP's multipliers
  long long deep_overlaps = 0;     // overlaps beyond the potential particle's radius
};

// Resolves each pair into the contact at the same place: status, geometry and proof. A contact that has a proof starts
// from it; a new one starts cold, so its result depends on the pair alone; one that rounding hid starts where the
// program ended. A pair gives the same bits alone and in any batch. History is not touched.
template <int Dim>
void narrow_phase(std::span<const Pair<Dim>> pairs, const ContactSettings& settings, const Solvers<Dim>& solvers,
                  std::span<Contact<Dim>* const> contacts, KernelCounters& counters);

// How far the second part stays behind a plane of the first's frame, m, rounding included: a lower bound of the
// distance between parts where nothing of the first lies beyond `support_a` along `axis`.
template <int Dim>
double gap_behind(const Pair<Dim>& pair, const Vector<Dim>& axis, double support_a);

// ---- the stages, each usable alone; all in one frame, planes of A first ---------------------------------------------

// Planes of both parts in the first body's frame, seen from `origin`.
template <int Dim>
void assemble(const Pair<Dim>& pair, const Vector<Dim>& origin, HalfSpaces<Dim>& planes);

// Direction from A to B at a point (Eqs 3.31-3.35): difference of the gradients of the parts' inner potentials
// sum <a·x - d + r>², normalised. False when it vanishes. `fallback` tells that a face normal stood in for a zero
// gradient.
template <int Dim>
bool contact_normal(const HalfSpaces<Dim>& planes, int faces_a, const Vector<Dim>& point, double radius,
                    Vector<Dim>& normal, bool& fallback);

// Overlap along the normal (Eq. 3.36) and the two faces that end it; false when the search meets no face.
template <int Dim>
bool overlap_along(const HalfSpaces<Dim>& planes, int faces_a, const Vector<Dim>& point, const Vector<Dim>& normal,
                   double& overlap, int& face_a, int& face_b);

// Area (2-D: length) of the section of the overlap region through the point normal to n (App. D, by clipping).
// `reach` bounds the section, m.
template <int Dim>
double section_area(const HalfSpaces<Dim>& planes, const Vector<Dim>& point, const Vector<Dim>& normal, double reach);

// The section itself, in axes about the point: perpendicular(n) and, in 3-D, n × perpendicular(n).
struct Segment {
  double low, high;  // m
};
Segment section_segment(const HalfSpaces<2>& planes, const Vector<2>& point, const Vector<2>& normal, double reach);
void section_polygon(const HalfSpaces<3>& planes, const Vector<3>& point, const Vector<3>& normal, double reach,
                     std::vector<Vector<2>>& polygon);

// what of a convex polygon lies in {y : q·y <= slack} (Sutherland and Hodgman)
void clip_polygon(const std::vector<Vector<2>>& polygon, const Vector<2>& q, double slack,
                  std::vector<Vector<2>>& clipped);

}  // namespace voussoir
