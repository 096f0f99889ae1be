// Joint sets: a random pattern of joints from the statistics that a geologist states.
//
// Finite joints are a marked Poisson process: centres of constant density in unbounded rock, sizes and orientations
// independent of place and of each other. Of it exactly those joints are drawn that may reach the ball around the
// domain, with the sizes that such joints have (large ones reach it from farther away): nothing is cut off at a margin,
// so there is no edge effect at the domain's border, for any law of sizes. Persistent joints are a Poisson process of
// planes, or planes at equal distances (Dershowitz & Herda 1992 for the measures of intensity).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/outline.hpp"

namespace voussoir {

enum class Scatter { none, fisher, normal };
enum class SizeLaw { persistent, constant, exponential, lognormal };
enum class Arrangement { poisson, equal };

struct JointSet {
  std::string name;
  double dip = 0, dip_direction = 0;  // rad, of the mean plane

  Scatter scatter = Scatter::none;
  double fisher_constant = 0;                             // of the poles (Fisher 1953); 3-D only
  double dip_deviation = 0, dip_direction_deviation = 0;  // rad, of independent normal laws; 2-D: of the trace's angle

  SizeLaw size_law = SizeLaw::persistent;
  double size_mean = 0,
         size_deviation = 0;  // m, moments of the size itself: extent along the strike, length of a trace
  OutlineForm shape = OutlineForm::ellipse;
  double elongation = 1;  // extent down the dip over that along the strike; 1: discs and squares

  // exactly one: mean distance along the mean normal, or area per volume P32 (2-D: length per area P21)
  std::optional<double> spacing, intensity;  // m; 1/m
  double persistence =
      1;  // with spacing: fraction of the planes at this spacing that is jointed (Einstein et al. 1983)
  Arrangement arrangement = Arrangement::poisson;  // of persistent joints
  std::vector<double> point;  // m, the file's coordinates: one of those at equal distances passes through it; empty:
                              // at a random place

  std::uint64_t seed = 0;
};

// E|cos| of the angle between the normals of the joints and of the mean plane: joints met per metre along the mean
// normal over intensity. Fisher: 1 - tanh(κ/2)/κ. Normal: exp(-σ²/2) of each angle; up to 30 degrees of deviation the
// normals beyond 90 degrees change it by less than 1e-3.
template <int Dim>
double mean_projection(const JointSet& set);

// stated P32 (2-D: P21) of the set, 1/m
template <int Dim>
double stated_intensity(const JointSet& set);

// mean area (2-D: length) of a joint, m² (2-D: m); of finite joints only
template <int Dim>
double mean_measure(const JointSet& set);

template <int Dim>
struct DrawnJoint {
  Vector<Dim> normal;  // upward, unit
  Vector<Dim> point;   // m, in the file's coordinates: the centre; of a persistent joint the point nearest the domain's
  double size = 0;     // m; 0: persistent
  Outline<Dim> outline;  // centred at the point
};

// The region that joints are drawn for, in the file's coordinates: a ball around all that is solid.
template <int Dim>
struct Ball {
  Vector<Dim> centre;
  double radius;  // m
};

template <int Dim>
Ball<Dim> ball_around(const Polytope<Dim>& domain, const Vector<Dim>& origin);

// how many joints `draw` draws on average: check it before drawing
template <int Dim>
double expected_number(const JointSet& set, double radius);

// All joints of the set that may reach the ball, in the order drawn. The same numbers on every platform: arithmetic is
// IEEE's and `portable_math`'s.
template <int Dim>
std::vector<DrawnJoint<Dim>> draw(const JointSet& set, const Ball<Dim>& ball);

// the plane of a joint seen from an origin
template <int Dim>
HalfSpace<Dim> plane_of(const DrawnJoint<Dim>& joint, const Vector<Dim>& origin);

// the same outline seen from an origin
template <int Dim>
Outline<Dim> outline_from(const DrawnJoint<Dim>& joint, const Vector<Dim>& origin) {
  Outline<Dim> outline = joint.outline;
  outline.centre -= origin;
  return outline;
}

}  // namespace voussoir
