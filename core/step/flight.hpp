// Pairs whose joint has risen: by how much they are drawn together, and blocks that fly above the risen plane.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/joint_laws/dilation.hpp"
#include "core/joint_laws/elastic_coulomb.hpp"
#include "core/joint_laws/joint_rise.hpp"
#include "core/model/bodies_state.hpp"
#include "core/model/contacts_state.hpp"
#include "core/model/model.hpp"

namespace voussoir {

// How much a joint of the model may rise at most over a step: m per m of slip, and the step's length, s; 0: nothing
// moves.
struct Climb {
  double steepest = 0, seconds = 0;
};

template <int Dim>
Climb climb_over(const Model<Dim>& model, double seconds) {
  Climb climb{0, seconds};
  for (const JointProperties& p : model.properties)
    climb.steepest = std::max(climb.steepest, steepest_dilation(p));
  return climb;
}

// m: by this a pair is drawn together before its contact is found, along the last normal of the joint: its highest
// rise, and a bound of what the slip of the last step may add to it, with `climb` of climb_over. Without that a
// block that slips farther in a step than its overlap over the dilation would lose its contact; closure_of subtracts
// what is too much. 0: the joint has never touched, or none of the model remembers its place.
template <int Dim>
double drawn_by(const Model<Dim>& model, const BodiesState<Dim>& bodies, const Contact<Dim>& c,
                std::span<const JointRise<Dim>> rises, const Climb& climb) {
  double highest = -1;
  for (const JointRise<Dim>& rise : rises)
    if (!rise.normal.isZero(0)) highest = std::max(highest, rise.rise);
  if (highest < 0 || climb.steepest == 0) return 0;
  const int first = model.parts[c.part_a].body, second = model.parts[c.part_b].body;
  const CachedPose<Dim>&a = bodies.poses[first], &b = bodies.poses[second];
  const double speed = (b.velocity - a.velocity).norm() + a.spin.norm() * model.bodies[first].radius +
                       b.spin.norm() * model.bodies[second].radius;
  return highest + climb.steepest * speed * climb.seconds;
}

// m: of the joint's spring, by the overlap that was found of the drawn pair
template <int Dim>
double closure_of(double overlap, double drawn, const JointRise<Dim>& rise) {
  return overlap - (drawn - rise.rise);
}

// the direction in which it is
template <int Dim>
Vector<Dim> drawn_along(std::span<const JointRise<Dim>> rises) {
  const auto touched = [](const JointRise<Dim>& rise) { return !rise.normal.isZero(0); };
  const auto most = std::ranges::max_element(rises, [&](const JointRise<Dim>& x, const JointRise<Dim>& y) {
    return std::pair(touched(x), x.rise) < std::pair(touched(y), y.rise);
  });
  return most == rises.end() ? Vector<Dim>(Vector<Dim>::Zero()) : most->normal;
}

// Its offset moves along with the block, by `way`, m, and its rise with the offset; `tangent`: dilation_in_force.
// Barton and Bandis' roughness, which raises only a joint that presses, keeps the rise of the farthest offset.
template <int Dim>
[[gnu::noinline]] void fly(const JointProperties& properties, double tangent, const Vector<Dim>& way,
                           std::span<JointRise<Dim>> rises) {
  for (JointRise<Dim>& rise : rises) {
    rise.stress = 0;
    if (!(rise.rise > 0)) continue;
    rise.offset -= way - way.dot(rise.normal) * rise.normal;  // against the slip, as a shear force is
    const double offset = length_of<Dim>(rise.offset);
    if (properties.states_barton_bandis()) {
      rise.farthest = std::max(rise.farthest, offset);
      rise.rise = rise_within(rise, offset);
    } else {
      rise.rise = rise_at(properties, tangent, offset);
    }
  }
}

}  // namespace voussoir
