// Leapfrog motion of one rigid body (velocities half a step behind positions) with Cundall's local damping.
#pragma once

#include <span>
#include <vector>

#include "core/model.hpp"
#include "core/settings.hpp"
#include "core/state.hpp"

namespace voussoir {

// the two halves of a step: velocities are kicked over half the last and half this time step, positions drift over this
// one; the last is 0 at the start alone, where velocities are given at the same time as positions
struct StepTimes {
  double kick, drift;  // s
  bool at_start() const { return kick == 0.5 * drift; }
  double booked() const { return at_start() ? drift : kick; }  // what the kick lasts for the books
};

// What a kick does to a body's energy, J. Each work comes in two halves: at the velocity before the kick and at the one
// after it; the kinetic energy (leapfrog's own, ½ m v₋·v₊ and the same for spins) stands between the two. At the start
// the velocity before is the one half a step earlier that would have led to the given one.
template <int Dim>
struct KickEnergy {
  double kinetic = 0;
  double load_before = 0, load_after = 0;                                           // work of the load before damping
  double damping_before = 0, damping_after = 0;                                     // lost to local damping
  double prescribed_before = 0, prescribed_after = 0;                               // put in by a prescribed motion
  Vector<Dim> path_before = Vector<Dim>::Zero(), path_after = Vector<Dim>::Zero();  // m: halves of the displacement the
                                                                                    // load acted along
  Spin<Dim> turn_before = Spin<Dim>::Zero(), turn_after = Spin<Dim>::Zero();        // rad: the same of its turn
};

// The part of that load's work that the stress on a body's outer faces does; bodies without any pay for none.
struct BoundaryWork {
  double before = 0, after = 0;
};
template <int Dim>
BoundaryWork boundary_work(const Body<Dim>& body, const Matrix<Dim>& axes, const KickEnergy<Dim>& kick) {
  if (body.boundary.empty()) return {};
  const Load<Dim> push = boundary_load(body, axes);
  return {push.force.dot(kick.path_before) + push.moment.dot(kick.turn_before),
          push.force.dot(kick.path_after) + push.moment.dot(kick.turn_after)};
}

// what a kick makes of a velocity: v -> keeps v + gain kick f/m, f the force that local damping leaves
struct KickRule {
  double local_damping = 0;
  double keeps = 1, gain = 1;
};

// Advances a free body by one step under its load. Translation: v by the kick, u += drift v on free freedoms. Rotation
// in 3-D: angular momentum is kicked by the moment, then the free rotation is split into turns about the principal axes
// (Dullweber, Leimkuhler & McLachlan 1997): reversible, symplectic, momentum kept exactly, exact inertia.
template <int Dim>
KickEnergy<Dim> advance(const Body<Dim>& body, const Load<Dim>& load, const KickRule& rule, StepTimes times,
                        Motion<Dim>& motion);

// Advances every free body, on as many threads; `rules` has one for each body, or one for all. What each kick did, by
// body: until the next call on this thread.
template <int Dim>
std::vector<KickEnergy<Dim>>& advance_bodies(const Model<Dim>& model, int threads, std::span<const KickRule> rules,
                                             StepTimes times, State<Dim>& state);

// force left after damping each component against its velocity: f - α |f| sign(v)
double damped(double force, double velocity, double local_damping);

// The largest share of the mean contact force that a body's unbalanced force and momentum still amount to (see
// EquilibriumSettings); infinity when bodies move without any contact. Under relaxation the momentum is that of the
// fictitious inertia, since this is what swings. Found on as many threads.
template <int Dim>
double unbalanced_ratio(const Model<Dim>& model, int threads, const State<Dim>& state);

}  // namespace voussoir
