// The energy balance, the bonds that broke, and the cost of a run.
#pragma once

#include <iterator>

#include "core/base/energy.hpp"

namespace voussoir {

// Bonds, counted by contact or sub-contact: the history of this state. Those not lost are in the contacts.
struct BondTally {
  long long made = 0, removed = 0;  // removed: not lost when one of their blocks was removed
};

// the tally, and the present state of the bonds
struct BondCount {
  long long made = 0, whole = 0, slipped = 0, broken = 0, removed = 0;
  long long due = 0;  // contacts whose joint is to be bonded when it is first compressed, and has not been yet
};

struct Ledger {
  EnergyBalance energy;
  BondTally bonds;
};

struct Counters {
  long long steps = 0;
  long long contact_evaluations = 0;  // pairs that went through the narrow phase
  long long motion_skips = 0;         // separated pairs whose bodies have not moved enough to meet
  long long axis_hits = 0;            // pairs still separated by the plane of the step before
  long long cold_starts = 0;          // pairs resolved without a start
  long long lp_solves = 0;
  long long lp_pivots = 0;
  long long newton_iterations = 0;
  long long areas = 0;
  long long undecided = 0;         // pairs nearer to touching than rounding resolves
  long long unconverged = 0;       // contacts without a result: the run fails
  long long normal_fallbacks = 0;  // normals taken from a face or from the LP's multipliers
  long long deep_overlaps = 0;     // overlaps beyond the potential particle's radius
  long long snap_backs = 0;        // slips in which friction fell faster than the shear spring could unload
  long long neighbour_builds = 0;
  long long static_iterations = 0;                                  // static solver: steps accepted
  long long static_iterations_of_few = 0;                           // and those of few bodies in between
  long long static_rejections = 0;                                  // steps shortened or refused
  long long linear_systems = 0;                                     // that it solved for all bodies
  long long linear_iterations = 0;                                  // of these: products with their matrices
  long long static_fallbacks = 0;                                   // increments that it left to relaxation
  long long broken_bonds_fallbacks = 0, unconverged_fallbacks = 0;  // because bonds broke; without equilibrium
  long long implicit_solutions = 0, implicit_iterations = 0;        // implicit steps: systems and their iterations
  long long implicit_refused = 0, implicit_halved = 0;              // whose error was too large; that were not solved
  long long implicit_by_load = 0, implicit_by_error = 0;            // what held the length of a step that was taken
};

// their names in results
struct CounterRow {
  const char* name;
  long long Counters::*value;
};

inline constexpr CounterRow counter_table[] = {
    {"steps", &Counters::steps},
    {"contact_evaluations", &Counters::contact_evaluations},
    {"motion_skips", &Counters::motion_skips},
    {"axis_hits", &Counters::axis_hits},
    {"cold_starts", &Counters::cold_starts},
    {"lp_solves", &Counters::lp_solves},
    {"lp_pivots", &Counters::lp_pivots},
    {"newton_iterations", &Counters::newton_iterations},
    {"areas", &Counters::areas},
    {"undecided", &Counters::undecided},
    {"unconverged", &Counters::unconverged},
    {"normal_fallbacks", &Counters::normal_fallbacks},
    {"deep_overlaps", &Counters::deep_overlaps},
    {"snap_backs", &Counters::snap_backs},
    {"neighbour_builds", &Counters::neighbour_builds},
    {"static_iterations", &Counters::static_iterations},
    {"static_iterations_of_few", &Counters::static_iterations_of_few},
    {"static_rejections", &Counters::static_rejections},
    {"linear_systems", &Counters::linear_systems},
    {"linear_iterations", &Counters::linear_iterations},
    {"static_fallbacks", &Counters::static_fallbacks},
    {"broken_bonds_fallbacks", &Counters::broken_bonds_fallbacks},
    {"unconverged_fallbacks", &Counters::unconverged_fallbacks},
    {"implicit_solutions", &Counters::implicit_solutions},
    {"implicit_iterations", &Counters::implicit_iterations},
    {"implicit_refused", &Counters::implicit_refused},
    {"implicit_halved", &Counters::implicit_halved},
    {"implicit_by_load", &Counters::implicit_by_load},
    {"implicit_by_error", &Counters::implicit_by_error},
};
static_assert(std::size(counter_table) * sizeof(long long) == sizeof(Counters), "every counter has a row");

}  // namespace voussoir
