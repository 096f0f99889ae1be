// The members of everything that Progress holds, for an archive. Each list is bound to its struct: a member that is
// added there and not here does not compile.
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

template <class Archive, int Dim>
void serialize(Archive& archive, Motion<Dim>& m) {
  auto& [displacement, rotation, velocity, angular_momentum] = m;
  archive(displacement, rotation, velocity, angular_momentum);
}

template <class Archive, int Dim>
void serialize(Archive& archive, Placement<Dim>& p) {
  auto& [displacement, rotation] = p;
  archive(displacement, rotation);
}

template <class Archive, int Dim>
void serialize(Archive& archive, Load<Dim>& l) {
  auto& [force, moment] = l;
  archive(force, moment);
}

template <class Archive, int Dim>
void serialize(Archive& archive, ContactGeometry<Dim>& g) {
  auto& [point, normal, overlap, area, stiffness_factor, face_a, face_b] = g;
  archive(point, normal, overlap, area, stiffness_factor, face_a, face_b);
}

template <class Archive, int Dim>
void serialize(Archive& archive, JointState<Dim>& j) {
  auto& [shear_force, normal, point, plastic_slip, dashpot, area, twist, polar, shear_stiffness, bonded] = j;
  archive(shear_force, normal, point, plastic_slip, dashpot, area, twist, polar, shear_stiffness, bonded);
}

template <class Archive, int Dim>
void serialize(Archive& archive, Proof<Dim>& p) {
  auto& [kind, margin, point, axis, tangent, support, basis, section, section_size] = p;
  archive(kind, margin, point, axis, tangent, support, basis, section, section_size);
}

template <class Archive, int Dim>
void serialize(Archive& archive, Contact<Dim>& c) {
  // whether it is near is found again
  auto& [part_a, part_b, joint, properties, cells, divided_face, status, bond_due, near_until, free_until, area_rated,
         force, geometry, history, proof] = c;
  archive(part_a, part_b, joint, properties, cells, divided_face, status, bond_due, force, geometry, history, proof,
          free_until, area_rated);
}

template <class Archive, int Dim>
void serialize(Archive& archive, SubContact<Dim>& s) {
  auto& [point, overlap, overlap_variance, gyration2, area, history, force] = s;
  archive(point, overlap, overlap_variance, gyration2, area, history, force);
}

template <class Archive, int Dim>
void serialize(Archive& archive, Relaxation<Dim>& r) {
  // what is imposed is found again before it is read
  auto& [under_way, rested, inertia, contact_load, imposed, until_renewal] = r;
  archive(under_way, rested, inertia, contact_load, until_renewal);
}

template <class Archive, int Dim>
void serialize(Archive& archive, PairStiffness<Dim>& p) {
  auto& [contact, body_a, body_b, stiffness, wrench, apart] = p;
  archive(contact, body_a, body_b, stiffness, wrench, apart);
}

template <class Archive, int Dim>
void serialize(Archive& archive, BaseHistory<Dim>& b) {
  auto& [part_a, part_b, divided_face, bond_due, history] = b;
  archive(part_a, part_b, divided_face, bond_due, history);
}

template <class Archive>
void serialize(Archive& archive, Schedule& s) {
  auto& [time, gravity_factor, last_gravity_factor, friction, strength_factor, water, last_water, started, ends] = s;
  archive(time, gravity_factor, last_gravity_factor, friction, strength_factor, water, last_water, started, ends);
}

template <class Archive>
void serialize(Archive& archive, BondTally& b) {
  auto& [made, removed] = b;
  archive(made, removed);
}

template <class Archive>
void serialize(Archive& archive, BondedContact& b) {
  auto& [part_a, part_b, joint, bonds, area] = b;
  archive(part_a, part_b, joint, bonds, area);
}

template <class Archive>
void serialize(Archive& archive, BondedContacts& b) {
  auto& [contacts, made] = b;
  archive(contacts, made);
}

template <class Archive>
void serialize(Archive& archive, BondCount& b) {
  auto& [made, whole, broken, removed, due] = b;
  archive(made, whole, broken, removed, due);
}

template <class Archive>
void serialize(Archive& archive, Counters& c) {
  for (const CounterRow& row : counter_table)
    archive(c.*row.value);
}

template <class Archive>
void serialize(Archive& archive, EnergyFlows& f) {
  for (double& flow : f.values)
    archive(flow);
}

template <class Archive>
void serialize(Archive& archive, EnergyLedger& e) {
  auto& [flows, kinetic, elastic, kinetic_origin, elastic_origin, motion_error, contact_error, worst_error,
         largest_energy, phase] = e;
  archive(flows, kinetic, elastic, kinetic_origin, elastic_origin, motion_error, contact_error, worst_error,
          largest_energy, phase);
}

template <class Archive, int Dim>
void serialize(Archive& archive, BoltSpring<Dim>& s) {
  auto& [bolt, number, body_a, body_b, place_a, place_b, axis, begin, end, length, stiffness, plastic, slip, broken,
         extension, force, shear] = s;
  archive(bolt, number, body_a, body_b, place_a, place_b, axis, begin, end, length, stiffness, plastic, slip, broken,
          extension, force, shear);
}

template <class Archive>
void serialize(Archive& archive, GroutedBar& b) {
  auto& [axial_stiffness, yield_force, bond_stiffness, bond_strength, plate, plate_stiffness, position, bond_length] =
      b;
  archive(axial_stiffness, yield_force, bond_stiffness, bond_strength, plate, plate_stiffness, position, bond_length);
}

template <class Archive>
void serialize(Archive& archive, GroutedBarState& s) {
  auto& [displacement, rock, bond_force, bond_strength, slip, bar_force, bar_strength, plastic_stretch, plate_force,
         plate_closure] = s;
  archive(displacement, rock, bond_force, bond_strength, slip, bar_force, bar_strength, plastic_stretch, plate_force,
          plate_closure);
}

template <class Archive, int Dim>
void serialize(Archive& archive, GroutedBolt<Dim>& g) {
  auto& [bolt, first_spring, bar, state, body, place, stretch, stiffness] = g;
  archive(bolt, first_spring, bar, state, body, place, stretch, stiffness);
}

template <class Archive>
void serialize(Archive& archive, LiningRock& r) {
  auto& [side, body, corner, normal, from, to] = r;
  archive(side, body, corner, normal, from, to);
}

template <class Archive>
void serialize(Archive& archive, LiningContact& c) {
  auto& [rock, bonded, closure, place, shear, plastic_slip, shear_stiffness, normal, dashpot] = c;
  archive(rock, bonded, closure, place, shear, plastic_slip, shear_stiffness, normal, dashpot);
}

template <class Archive>
void serialize(Archive& archive, LiningState& l) {
  auto& [lining, rock, contacts] = l;
  archive(lining, rock, contacts);
}

template <class Archive, int Dim>
void serialize(Archive& archive, BodiesState<Dim>& b) {
  // poses are rebuilt before they are read
  auto& [motions, poses, listed_at, counted_at, path_bounds, left_behind] = b;
  archive(motions, listed_at, counted_at, path_bounds, left_behind);
}

template <class Archive, int Dim>
void serialize(Archive& archive, ContactsState<Dim>& c) {
  // faces, lists by body and loads are found before they are read
  auto& [list, subs, faces, by_body, loads] = c;
  archive(list, subs);
}

template <class Archive, int Dim>
void serialize(Archive& archive, SupportsState<Dim>& s) {
  auto& [bolt_springs, grouted, linings] = s;
  archive(bolt_springs, grouted, linings);
}

template <class Archive>
void serialize(Archive& archive, Ledger& l) {
  auto& [energy, bonds] = l;
  archive(energy, bonds);
}

template <class Archive>
void serialize(Archive& archive, TimeStep& t) {
  auto& [length, allowed, frequency] = t;
  archive(length, allowed, frequency);
}

template <class Archive, int Dim>
void serialize(Archive& archive, StaticIncrement<Dim>& n) {
  auto& [under_way, trial, increments_left, increment_time, ends, iteration, since_commit, tries, flat, polished,
         regularisation, overshoot, base, histories, supports, whole_bonds, sub_histories, listed, loads_begin, ledger,
         accepted, residual, change, merits, stiffness, closed, of_water] = n;
  archive(under_way, trial, increments_left, increment_time, ends, iteration, since_commit, tries, flat, polished,
          regularisation, overshoot, base, histories, supports, whole_bonds, sub_histories, listed, loads_begin.values,
          ledger, accepted, residual, change, merits, stiffness, closed, of_water);
}

template <class Archive, int Dim>
void serialize(Archive& archive, ReliefLoad<Dim>& h) {
  auto& [body, load, begun, share] = h;
  archive(body, load, begun, share);
}

template <class Archive, int Dim>
void serialize(Archive& archive, LoadsState<Dim>& l) {
  // loads by source and their stiffness are found before they are read
  auto& [total, by_source, stiffened, relief] = l;
  archive(total, relief);
}

template <class Archive, int Dim>
void serialize(Archive& archive, State<Dim>& s) {
  auto& [bodies, contacts, supports, loads, schedule, ledger, counters, time_step, relaxation, increment] = s;
  archive(bodies, contacts, supports, loads, schedule, ledger, counters, time_step, relaxation, increment);
}

template <class Archive, int Dim>
void serialize(Archive& archive, RunProgress<Dim>& r) {
  auto& [under_way, steps, at_rest, unconverged, begin] = r;
  archive(under_way, steps, at_rest, unconverged, begin);
}

template <class Archive, int Dim>
void serialize(Archive& archive, ReductionProgress<Dim>& r) {
  auto& [trial, target, level_from, level_rate, time_limit, stable, failed, failed_faster, unbalanced, true_motion,
         trial_steps, avoids, undecided, run, begin, base] = r;
  archive(trial, target, level_from, level_rate, time_limit, stable, failed, failed_faster, unbalanced, true_motion,
          trial_steps, avoids, undecided, run, begin, base);
}

template <class Archive>
void serialize(Archive& archive, StageRecord& r) {
  auto& [interval, next, step, spacing, rows] = r;
  archive(interval, next, step, spacing, rows);
}

template <class Archive>
void serialize(Archive& archive, Value& v) {
  // a budget is made after the last checkpoint
  auto& [value, unit, error_bar, rule, covers, bracket, budget, divides] = v;
  archive(value, unit, error_bar, rule, divides);
}

template <class Archive>
void serialize(Archive& archive, StageResult& s) {
  auto& [name, kind, ended, relaxed, steps, time, time_step, unbalanced] = s;
  archive(name, kind, ended, relaxed, steps, time, time_step, unbalanced);
}

template <class Archive>
void serialize(Archive& archive, History& h) {
  auto& [columns, rows] = h;
  archive(columns, rows);
}

template <class Archive>
void serialize(Archive& archive, BoltRow& b) {
  auto& [stage, bolts, bolt, joint, x, y, z, body_a, body_b, force, shear, extension, plastic, use, broken, slip] = b;
  archive(stage, bolts, bolt, joint, x, y, z, body_a, body_b, force, shear, extension, plastic, use, broken, slip);
}

template <class Archive>
void serialize(Archive& archive, LiningRow& l) {
  auto& [stage, lining, node, x, y, ux, uy, forces, smoothed_moment, pressure, shear, rock, use] = l;
  auto& [thrust, shear_force, moment] = forces;
  archive(stage, lining, node, x, y, ux, uy, thrust, shear_force, moment, smoothed_moment, pressure, shear, rock, use);
}

template <class Archive>
void serialize(Archive& archive, BondsOfJoint& b) {
  auto& [joint, whole, made, area_share] = b;
  archive(joint, whole, made, area_share);
}

template <class Archive>
void serialize(Archive& archive, WholeBonds& b) {
  auto& [whole, made, by_joint] = b;
  archive(whole, made, by_joint);
}

template <class Archive>
void serialize(Archive& archive, StableState& s) {
  auto& [stage, kind, level, unit, bonds] = s;
  archive(stage, kind, level, unit, bonds);
}

template <class Archive>
void serialize(Archive& archive, MovedBody& m) {
  auto& [stage, body, name, distance, inscribed_radius, against, place, left_all] = m;
  archive(stage, body, name, distance, inscribed_radius, against, place, left_all);
}

template <class Archive>
void serialize(Archive& archive, Results& r) {
  auto& [outcome, message, values, stages, at_last_stable_state, history, bolts_carried, linings_carried, counters,
         bonds, moved, relief_left, energy, state_hash, warnings, seconds, budget_evaluations] = r;
  archive(outcome, message, values, stages, at_last_stable_state, history, bolts_carried, linings_carried, counters,
          bonds, moved, relief_left, energy, state_hash, warnings, seconds);
}

template <class Archive>
void serialize(Archive& archive, NearBodies& n) {
  auto& [a, b, touched] = n;
  archive(a, b, touched);
}

template <class Archive, int Dim>
void serialize(Archive& archive, SettleBegin<Dim>& s) {
  auto& [placed, near] = s;
  archive(placed, near);
}

template <class Archive, int Dim>
void serialize(Archive& archive, StageEnd<Dim>& e) {
  auto& [stage, bodies] = e;
  archive(stage, bodies);
}

template <class Archive, int Dim>
void serialize(Archive& archive, Progress<Dim>& p) {
  auto& [state, stage, stage_under_way, stage_began, steps_before, run, settle, reduction, record, next_frame, frames,
         trial_frames, ends, bonded, results] = p;
  archive(state, stage, stage_under_way, stage_began, steps_before, run, settle, reduction, record, next_frame, frames,
          trial_frames, ends, bonded, results);
}

// every bit of it: two objects are the same when these are equal
template <class T>
std::string bytes_of(const T& object) {
  std::ostringstream stream(std::ios::binary);
  cereal::BinaryOutputArchive archive(stream);
  archive(object);
  return std::move(stream).str();
}

}  // namespace voussoir
