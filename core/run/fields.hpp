// The members of all parts of Progress except the state (core/model/fields.hpp), and the archive that saves both.
#pragma once

#include <cereal/archives/binary.hpp>
#include <cereal/cereal.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/utility.hpp>
#include <cereal/types/vector.hpp>
#include <sstream>
#include <string>
#include <utility>

#include "core/model/fields.hpp"
#include "core/run/progress.hpp"

namespace Eigen {

// fixed sizes only
template <class Archive, int Rows, int Columns, int Options>
void serialize(Archive& archive, Matrix<double, Rows, Columns, Options>& m) {
  static_assert(Rows > 0 && Columns > 0);
  for (int i = 0; i < Rows * Columns; ++i)
    archive(m.data()[i]);
}

}  // namespace Eigen

namespace voussoir {

template <class Archive>
void serialize(Archive& archive, Rotation<2>& r) {
  archive(r.angle);
}
template <class Archive>
void serialize(Archive& archive, Rotation<3>& r) {
  archive(r.quaternion.coeffs());
}

// saves and reads hashed and saved members, in the order of their list
template <class Archive>
struct ArchivedFields {
  Archive& archive;

  void operator()(Hashed, auto&... fields) const { archive(fields...); }
  void operator()(HashedIfSet, auto&... fields) const { archive(fields...); }
  void operator()(Saved, auto&... fields) const { archive(fields...); }
  void operator()(Found, auto&...) const {}
};

template <class Archive, HasFields T>
void serialize(Archive& archive, T& object) {
  visit_fields(object, ArchivedFields<Archive>{archive});
}

void visit_fields(Just<BondedContact> auto& b, auto&& visit) {
  auto& [part_a, part_b, joint, bonds, area] = b;
  visit(Saved{}, part_a, part_b, joint, bonds, area);
}

void visit_fields(Just<BondedContacts> auto& b, auto&& visit) {
  auto& [contacts, made] = b;
  visit(Saved{}, contacts, made);
}

void visit_fields(Just<BondCount> auto& b, auto&& visit) {
  auto& [made, whole, slipped, broken, removed, due] = b;
  visit(Saved{}, made, whole, slipped, broken, removed, due);
}

void visit_fields(Either<RunProgress> auto& r, auto&& visit) {
  auto& [under_way, steps, at_rest, unconverged, begin] = r;
  visit(Saved{}, under_way, steps, at_rest, unconverged, begin);
}

void visit_fields(Just<WatchPlan> auto& w, auto&& visit) {
  auto& [searched, properties, elastic, moved_away, tolerance] = w;
  visit(Saved{}, searched, properties, elastic, moved_away, tolerance);
}

void visit_fields(Just<RequiredStrength> auto& r, auto&& visit) {
  auto& [displacement, strength] = r;
  visit(Saved{}, displacement, strength);
}

void visit_fields(Either<TrialWatch> auto& t, auto&& visit) {
  auto& [first, last, bolts, bonds, target, looks, required, elastic, lost, straight, turns, broke, loads] = t;
  visit(Saved{}, first, last, bolts, bonds, target, looks, required, elastic, lost, straight, turns, broke, loads);
}

void visit_fields(Either<FailureWatch> auto& w, auto&& visit) {
  auto& [plan, trial] = w;
  visit(Saved{}, plan, trial);
}

void visit_fields(Just<TrialEstimate> auto& e, auto&& visit) {
  auto& [level, critical, taken_out] = e;
  visit(Saved{}, level, critical, taken_out);
}

void visit_fields(Just<StableTrial> auto& t, auto&& visit) {
  auto& [level, displacement, of_failure] = t;
  visit(Saved{}, level, displacement, of_failure);
}

void visit_fields(Just<SearchEstimates> auto& k, auto&& visit) {
  auto& [failed, stable, no_line] = k;
  visit(Saved{}, failed, stable, no_line);
}

void visit_fields(Either<ReductionProgress> auto& r, auto&& visit) {
  auto& [trial, target, level_from, level_rate, time_limit, stable, failed, failed_faster, unbalanced, true_motion,
         trial_steps, avoids, undecided, run, begin, water, base, failed_from, watch, known, begun, leg, failed_way,
         searched_steps] = r;
  visit(Saved{}, trial, target, level_from, level_rate, time_limit, stable, failed, failed_faster, unbalanced,
        true_motion, trial_steps, avoids, undecided, run, begin, water, base, failed_from, watch, known, begun, leg,
        failed_way, searched_steps);
}

void visit_fields(Just<StageRecord> auto& r, auto&& visit) {
  auto& [interval, next, step, spacing, rows] = r;
  visit(Saved{}, interval, next, step, spacing, rows);
}

void visit_fields(Just<Value> auto& v, auto&& visit) {
  // a budget is made after the last checkpoint
  auto& [value, unit, error_bar, rule, covers, bracket, budget, divides, found_by, bracket_middle, criterion, turned,
         not_varied] = v;
  visit(Saved{}, value, unit, error_bar, rule, covers, bracket, divides, found_by, bracket_middle, criterion, turned);
  visit(Found{}, budget, not_varied);
}

void visit_fields(Just<HalfErrorResult> auto& h, auto&& visit) {
  auto& [body, name, displacement, change] = h;
  visit(Saved{}, body, name, displacement, change);
}

void visit_fields(Just<StageResult> auto& s, auto&& visit) {
  auto& [name, kind, ended, relaxed, steps, time, time_step, shortest_step, unbalanced, mechanism, half_error] = s;
  visit(Saved{}, name, kind, ended, relaxed, steps, time, time_step, shortest_step, unbalanced, mechanism, half_error);
}

void visit_fields(Just<History> auto& h, auto&& visit) {
  auto& [columns, rows] = h;
  visit(Saved{}, columns, rows);
}

void visit_fields(Just<BoltRow> auto& b, auto&& visit) {
  auto& [stage, bolts, bolt, joint, x, y, z, body_a, body_b, force, shear, extension, plastic, use, broken, slip] = b;
  visit(Saved{}, stage, bolts, bolt, joint, x, y, z, body_a, body_b, force, shear, extension, plastic, use, broken,
        slip);
}

void visit_fields(Just<LiningRow> auto& l, auto&& visit) {
  auto& [stage, lining, node, x, y, ux, uy, forces, smoothed_moment, pressure, shear, rock, use] = l;
  auto& [thrust, shear_force, moment] = forces;
  visit(Saved{}, stage, lining, node, x, y, ux, uy, thrust, shear_force, moment, smoothed_moment, pressure, shear, rock,
        use);
}

void visit_fields(Just<BondsOfJoint> auto& b, auto&& visit) {
  auto& [joint, whole, slipped, made, area_share] = b;
  visit(Saved{}, joint, whole, slipped, made, area_share);
}

void visit_fields(Just<WholeBonds> auto& b, auto&& visit) {
  auto& [whole, slipped, made, by_joint] = b;
  visit(Saved{}, whole, slipped, made, by_joint);
}

void visit_fields(Just<MovingJoint> auto& j, auto&& visit) {
  auto& [joint, slip, opening, force, slips, opens, carries] = j;
  visit(Saved{}, joint, slip, opening, force, slips, opens, carries);
}

void visit_fields(Just<MovingCluster> auto& c, auto&& visit) {
  auto& [bodies, volume, weight, free_share, motion, displacement, farthest, plunge, trend, turn, about, at_edge, axis,
         along_line, joints] = c;
  visit(Saved{}, bodies, volume, weight, free_share, motion, displacement, farthest, plunge, trend, turn, about,
        at_edge, axis, along_line, joints);
}

void visit_fields(Just<BondsOfMotion> auto& b, auto&& visit) {
  auto& [broken, slipped, whole] = b;
  visit(Saved{}, broken, slipped, whole);
}

void visit_fields(Just<FailureMechanism> auto& m, auto&& visit) {
  auto& [dimension, clusters, free_share, bonds] = m;
  visit(Saved{}, dimension, clusters, free_share, bonds);
}

void visit_fields(Just<TrialRow> auto& t, auto&& visit) {
  auto& [stage, trial, level, unit, outcome, body, name, displacement, elastic_displacements, required, bolts_turned,
         bolts_use, water_lost, mechanism] = t;
  visit(Saved{}, stage, trial, level, unit, outcome, body, name, displacement, elastic_displacements, required,
        bolts_turned, bolts_use, water_lost, mechanism);
}

void visit_fields(Just<FollowedTrial> auto& f, auto&& visit) {
  auto& [rests, displacement, steps, ended] = f;
  visit(Saved{}, rests, displacement, steps, ended);
}

void visit_fields(Just<StableState> auto& s, auto&& visit) {
  auto& [stage, kind, level, unit, bonds, trial, failed, taken_out, bracket_because, followed, block_theory] = s;
  visit(Saved{}, stage, kind, level, unit, bonds, trial, failed, taken_out, bracket_because, followed);
  visit(Found{}, block_theory);
}

void visit_fields(Just<MovedBody> auto& m, auto&& visit) {
  auto& [stage, body, name, distance, inscribed_radius, against, place, left_all] = m;
  visit(Saved{}, stage, body, name, distance, inscribed_radius, against, place, left_all);
}

void visit_fields(Just<Results> auto& r, auto&& visit) {
  auto& [outcome, message, values, stages, at_last_stable_state, history, trials, bolts_carried, linings_carried,
         counters, bonds, cohesion, moved, forces_remaining, energy, state_hash, warnings, seconds,
         budget_evaluations] = r;
  visit(Saved{}, outcome, message, values, stages, at_last_stable_state, history, trials, bolts_carried,
        linings_carried, counters, bonds, cohesion, moved, forces_remaining, energy, state_hash, warnings, seconds);
  visit(Found{}, budget_evaluations);
}

void visit_fields(Just<NearBodies> auto& n, auto&& visit) {
  auto& [a, b, touched] = n;
  visit(Saved{}, a, b, touched);
}

void visit_fields(Either<SettleBegin> auto& s, auto&& visit) {
  auto& [placed, near, contacts] = s;
  visit(Saved{}, placed, near, contacts);
}

void visit_fields(Either<StageEnd> auto& e, auto&& visit) {
  auto& [stage, bodies] = e;
  visit(Saved{}, stage, bodies);
}

void visit_fields(Either<Progress> auto& p, auto&& visit) {
  auto& [state, stage, stage_under_way, stage_began, steps_before, run, settle, broken_before_stage, reduction, record,
         next_frame, frames, trial_frames, ends, bonded, by_half_error, results] = p;
  visit(Saved{}, state, stage, stage_under_way, stage_began, steps_before, run, settle, broken_before_stage, reduction,
        record, next_frame, frames, trial_frames, ends, bonded, by_half_error, results);
}

// all bits of it: two objects are the same if these are equal
template <class T>
std::string bytes_of(const T& object) {
  std::ostringstream stream(std::ios::binary);
  cereal::BinaryOutputArchive archive(stream);
  archive(object);
  return std::move(stream).str();
}

}  // namespace voussoir
