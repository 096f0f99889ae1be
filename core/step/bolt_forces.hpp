// Forces of bolts on their blocks (core/support/bolt.hpp, core/support/grouted_bolt.hpp): the entries of their rows in
// support_table.hpp.
#pragma once

#include <optional>
#include <vector>

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"
#include "core/step/joint_forces.hpp"
#include "core/step/load_row.hpp"
#include "core/step/support_questions.hpp"

namespace voussoir {

template <int Dim>
bool has_springs(const Model<Dim>& model, const LoadInputs<Dim>& now);
template <int Dim>
bool has_bars(const Model<Dim>& model, const LoadInputs<Dim>& now);

// The forces of springs that do not belong to a bar.
template <int Dim>
void find_spring_forces(const Model<Dim>& model, const Schedule& schedule, const JointStep& last,
                        const BodiesState<Dim>& bodies, SupportsState<Dim>& supports, Ledger& ledger,
                        Counters& counters);

// Those of grouted bars and of the springs at their joints. A bar without equilibrium counts as unconverged.
template <int Dim>
void find_bar_forces(const Model<Dim>& model, const Schedule& schedule, const JointStep& last,
                     const BodiesState<Dim>& bodies, SupportsState<Dim>& supports, Ledger& ledger, Counters& counters);

// of all springs, including those of bars
template <int Dim>
void bolt_loads(const Model<Dim>& model, int threads, const LoadInputs<Dim>& now, std::vector<Load<Dim>>& loads);

template <int Dim>
void add_spring_stiffness(const Model<Dim>& model, const LoadInputs<Dim>& now, std::vector<BodyStiffness>& stiffness);
template <int Dim>
void add_bar_stiffness(const Model<Dim>& model, const LoadInputs<Dim>& now, std::vector<BodyStiffness>& stiffness);

// a pair for each unbroken spring with a free body
template <int Dim>
void add_spring_pairs(const Model<Dim>& model, const Settings& settings, const State<Dim>& state,
                      std::vector<PairStiffness<Dim>>& pairs);

// One for any two segments of a bar: between neighbours with the force at their joint, between others as if the bar
// were straight.
template <int Dim>
void add_bar_pairs(const Model<Dim>& model, const Settings& settings, const State<Dim>& state,
                   std::vector<PairStiffness<Dim>>& pairs);

// rad: the largest angle of an unbroken spring that acts on a free body with its direction at installation, against the
// block nearer to its collar; nothing without such springs. Of those with both anchors at the joint: 0, as their force
// keeps its direction.
template <int Dim>
std::optional<double> most_turned(const Model<Dim>& model, const BodiesState<Dim>& bodies,
                                  const SupportsState<Dim>& supports);

// of all unbroken springs
template <int Dim>
void add_spring_forces(const SupportsState<Dim>& supports, ForcesAtRest& sums);
template <int Dim>
bool hangs_on_spring(const SupportsState<Dim>& supports, int body);
template <int Dim>
void tie_springs(const Model<Dim>& model, const SupportsState<Dim>& supports, const TwoBodies& tie);

template <int Dim>
void tie_bars(const Model<Dim>& model, const SupportsState<Dim>& supports, const TwoBodies& tie);

}  // namespace voussoir
