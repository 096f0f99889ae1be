// The members of a struct that are saved, hashed or recomputed, listed once for each struct: the checkpoint
// (core/run/fields.hpp) and the hash of a state (state_hash.cpp) follow from it. Each list is bound to its struct: a
// member that is added there and not here does not compile.
//
// visit_fields(object, visit) calls visit(use, members...), in the order in which they are hashed, with
//   Hashed       part of the state's hash, and saved
//   HashedIfSet  the same, if it is not zero
//   Saved        saved: follows from hashed members, or belongs to an iteration, or is constant during a simulation
//   Found        neither: recomputed before it is read
#pragma once

#include <concepts>
#include <type_traits>

#include "core/model/state.hpp"

namespace voussoir {

struct Hashed {};
struct HashedIfSet {};
struct Saved {};
struct Found {};

// T is the struct itself, const or not: a template of the dimension, or a plain one
template <class T, template <int> class Struct>
concept Either = std::same_as<std::remove_const_t<T>, Struct<2>> || std::same_as<std::remove_const_t<T>, Struct<3>>;
template <class T, class Struct>
concept Just = std::same_as<std::remove_const_t<T>, Struct>;

// whether T has a list here, or in a header above this one
template <class T>
concept HasFields = requires(T& object, void (*visit)(...)) {
  visit_fields(object, visit);
};

// ---- bodies --------------------------------------------------------------------------------------------------------

void visit_fields(Either<Motion> auto& m, auto&& visit) {
  auto& [displacement, rotation, velocity, angular_momentum] = m;
  visit(Hashed{}, displacement, rotation, velocity, angular_momentum);
}

void visit_fields(Either<Placement> auto& p, auto&& visit) {
  auto& [displacement, rotation] = p;
  visit(Saved{}, displacement, rotation);
}

void visit_fields(Either<BodiesState> auto& b, auto&& visit) {
  auto& [motions, poses, listed_at, counted_at, path_bounds, left_behind] = b;
  visit(Hashed{}, motions);
  visit(Saved{}, listed_at, counted_at, path_bounds, left_behind);
  visit(Found{}, poses);
}

// ---- contacts ------------------------------------------------------------------------------------------------------

void visit_fields(Either<ContactGeometry> auto& g, auto&& visit) {
  auto& [point, normal, overlap, area, stiffness_factor, face_a, face_b] = g;
  visit(Saved{}, point, normal, overlap, area, stiffness_factor, face_a, face_b);
}

void visit_fields(Either<JointState> auto& j, auto&& visit) {
  auto& [shear_force, normal, point, plastic_slip, dashpot, area, twist, polar, shear_stiffness, bond_slip, bond] = j;
  visit(Hashed{}, shear_force, normal, point, plastic_slip);
  visit(HashedIfSet{}, twist);
  visit(Hashed{}, shear_stiffness, bond);
  visit(HashedIfSet{}, bond_slip);
  visit(Saved{}, dashpot, area, polar);
}

void visit_fields(Either<JointRise> auto& j, auto&& visit) {
  auto& [offset, normal, rise, stress, largest_closure, farthest, rise_there] = j;
  visit(Hashed{}, offset, normal, rise, stress, largest_closure);
  visit(HashedIfSet{}, farthest);
  visit(HashedIfSet{}, rise_there);
}

void visit_fields(Either<Proof> auto& p, auto&& visit) {
  auto& [kind, margin, point, axis, tangent, support, basis, section, section_size] = p;
  visit(Saved{}, kind, margin, point, axis, tangent, support, basis, section, section_size);
}

// of one that touches; of one that does not, its parts if a bond is due
void visit_fields(Either<Contact> auto& c, auto&& visit) {
  auto& [part_a, part_b, joint, properties, cells, divided_face, status, bond_due, near_until, free_until, area_rated,
         force, geometry, history, proof] = c;
  visit(Hashed{}, part_a, part_b, cells, history);
  visit(Saved{}, joint, properties, divided_face, status, bond_due, free_until, area_rated, force, geometry, proof);
  visit(Found{}, near_until);
}

void visit_fields(Either<SubContact> auto& s, auto&& visit) {
  auto& [point, overlap, overlap_variance, gyration2, area, history, force] = s;
  visit(Hashed{}, history);
  visit(Saved{}, point, overlap, overlap_variance, gyration2, area, force);
}

void visit_fields(Just<PressedPolygon> auto& p, auto&& visit) {
  auto& [corners, axes, overlap, gradient] = p;
  visit(Saved{}, corners, axes, overlap, gradient);
}

void visit_fields(Either<IntegratedContact> auto& c, auto&& visit) {
  auto& [flat, normal, centre, force, couple, square, polar, gyration2, polygon] = c;
  visit(Saved{}, flat, normal, centre, force, couple, square, polar, gyration2, polygon);
}

void visit_fields(Either<ContactLoad> auto& l, auto&& visit) {
  auto& [second, force, about_first, about_second] = l;
  visit(Saved{}, second, force, about_first, about_second);
}

void visit_fields(Either<ContactsState> auto& c, auto&& visit) {
  auto& [list, subs, rises, faces, by_body, loads, kept] = c;
  visit(Hashed{}, list, subs, rises);
  visit(Saved{}, faces, loads, kept);
  visit(Found{}, by_body);
}

// ---- supports ------------------------------------------------------------------------------------------------------

void visit_fields(Either<BoltSpring> auto& s, auto&& visit) {
  auto& [bolt, number, body_a, body_b, place_a, place_b, axis, begin, end, length, stiffness, plastic, slip, broken,
         extension, force, shear] = s;
  visit(Hashed{}, bolt, number, body_a, body_b, place_a, place_b, axis, length, stiffness, plastic, slip, broken, force,
        shear);
  visit(Saved{}, begin, end, extension);
}

void visit_fields(Just<GroutedBar> auto& b, auto&& visit) {
  auto& [axial_stiffness, yield_force, bond_stiffness, bond_strength, plate, plate_stiffness, position, bond_length] =
      b;
  visit(Hashed{}, position, bond_length);
  visit(Saved{}, axial_stiffness, yield_force, bond_stiffness, bond_strength, plate, plate_stiffness);
}

void visit_fields(Just<GroutedBarState> auto& s, auto&& visit) {
  auto& [displacement, rock, bond_force, bond_strength, slip, bar_force, bar_strength, plastic_stretch, plate_force,
         plate_closure] = s;
  visit(Hashed{}, displacement, rock, bond_force, bond_strength, slip, bar_force, bar_strength, plastic_stretch,
        plate_force, plate_closure);
}

void visit_fields(Either<GroutedBolt> auto& g, auto&& visit) {
  auto& [bolt, first_spring, bar, state, body, place, stretch, stiffness] = g;
  visit(Hashed{}, bolt, first_spring, body, place, bar, state);
  visit(Saved{}, stretch, stiffness);
}

void visit_fields(Just<LiningRock> auto& r, auto&& visit) {
  auto& [side, body, corner, normal, from, to] = r;
  visit(Saved{}, side, body, corner, normal, from, to);
}

void visit_fields(Just<LiningContact> auto& c, auto&& visit) {
  auto& [rock, bond, closure, place, shear, plastic_slip, bond_slip, shear_stiffness, normal, dashpot] = c;
  visit(Hashed{}, rock, closure, place, shear, plastic_slip, normal, bond);
  visit(HashedIfSet{}, bond_slip);
  visit(Saved{}, shear_stiffness, dashpot);
}

void visit_fields(Just<LiningState> auto& l, auto&& visit) {
  auto& [lining, rock, contacts] = l;
  visit(Hashed{}, lining, contacts);
  visit(Saved{}, rock);
}

void visit_fields(Either<SupportsState> auto& s, auto&& visit) {
  auto& [bolt_springs, grouted, linings] = s;
  visit(Hashed{}, bolt_springs, grouted, linings);
}

// ---- loads and schedules -------------------------------------------------------------------------------------------

void visit_fields(Either<Load> auto& l, auto&& visit) {
  auto& [force, moment] = l;
  visit(Hashed{}, force, moment);
}

void visit_fields(Either<ReliefLoad> auto& r, auto&& visit) {
  auto& [body, load, begun, share] = r;
  visit(Hashed{}, body, load, share);
  visit(Saved{}, begun);
}

void visit_fields(Either<PlateState> auto& p, auto&& visit) {
  auto& [face, plate, face_of_column, face_origin, column_origin, force] = p;
  visit(Hashed{}, face, plate);
  visit(Saved{}, face_of_column, face_origin, column_origin, force);
}

void visit_fields(Either<ConstantLoad> auto& l, auto&& visit) {
  auto& [body, load] = l;
  visit(Hashed{}, body, load);
}

void visit_fields(Either<ColumnLoad> auto& l, auto&& visit) {
  auto& [at_begin, now] = l;
  visit(Hashed{}, at_begin);
  visit(Saved{}, now);
}

void visit_fields(Either<ImageOffset> auto& o, auto&& visit) {
  auto& [displacement, rotation] = o;
  visit(Hashed{}, displacement, rotation);
}

void visit_fields(Either<OpenSidesState> auto& o, auto&& visit) {
  auto& [time, plates, reactions, columns, images] = o;
  visit(Hashed{}, plates, reactions, columns, images);
  visit(Saved{}, time);
}

void visit_fields(Either<LoadsState> auto& l, auto&& visit) {
  auto& [total, by_source, stiffened, relief, open_sides] = l;
  visit(Hashed{}, relief, open_sides);
  visit(Saved{}, total);
  visit(Found{}, by_source, stiffened);
}

void visit_fields(Just<Schedule> auto& s, auto&& visit) {
  auto& [time, gravity_factor, last_gravity_factor, friction, strength_factor, water, last_water, started, ends] = s;
  visit(Hashed{}, water);
  visit(Saved{}, time, gravity_factor, last_gravity_factor, friction, strength_factor, last_water, started, ends);
}

// ---- counts --------------------------------------------------------------------------------------------------------

void visit_fields(Just<BondTally> auto& b, auto&& visit) {
  auto& [made, removed] = b;
  visit(Saved{}, made, removed);
}

void visit_fields(Just<EnergyFlows> auto& f, auto&& visit) {
  auto& [values] = f;
  visit(Saved{}, values);
}

void visit_fields(Just<EnergyBalance> auto& e, auto&& visit) {
  auto& [flows, kinetic, elastic, kinetic_origin, elastic_origin, motion_error, contact_error, worst_error,
         largest_energy, phase] = e;
  visit(Saved{}, flows, kinetic, elastic, kinetic_origin, elastic_origin, motion_error, contact_error, worst_error,
        largest_energy, phase);
}

void visit_fields(Just<Ledger> auto& l, auto&& visit) {
  auto& [energy, bonds] = l;
  visit(Saved{}, energy, bonds);
}

void visit_fields(Just<Counters> auto& c, auto&& visit) {
  for (const CounterRow& row : counter_table)
    visit(Saved{}, c.*row.value);
}

// ---- solvers -------------------------------------------------------------------------------------------------------

void visit_fields(Just<TimeStep> auto& t, auto&& visit) {
  auto& [length, allowed, frequency, shortest, longest] = t;
  visit(Saved{}, length, allowed, frequency, shortest, longest);
}

void visit_fields(Either<Relaxation> auto& r, auto&& visit) {
  auto& [under_way, rested, inertia, contact_load, imposed, until_renewal] = r;
  visit(Saved{}, under_way, rested, inertia, contact_load, until_renewal);
  visit(Found{}, imposed);
}

void visit_fields(Either<PairStiffness> auto& p, auto&& visit) {
  auto& [contact, body_a, body_b, stiffness, wrench, apart] = p;
  visit(Saved{}, contact, body_a, body_b, stiffness, wrench, apart);
}

void visit_fields(Either<ContactHistory> auto& c, auto&& visit) {
  auto& [part_a, part_b, cells, divided_face, bond_due, history] = c;
  visit(Saved{}, part_a, part_b, cells, divided_face, bond_due, history);
}

void visit_fields(Either<JointHistories> auto& h, auto&& visit) {
  auto& [contacts, subs, rises] = h;
  visit(Saved{}, contacts, subs, rises);
}

void visit_fields(Either<StaticBase> auto& b, auto&& visit) {
  auto& [motions, histories, supports, ledger, loads, held_bonds, listed] = b;
  visit(Saved{}, motions, histories, supports, ledger, loads.values, held_bonds, listed);
}

void visit_fields(Just<StepsOfFew> auto& f, auto&& visit) {
  auto& [list, since_all, regularisation, merit, merit_of_all, went_far] = f;
  visit(Saved{}, list, since_all, regularisation, merit, merit_of_all, went_far);
}

void visit_fields(Just<StaticProgress> auto& p, auto&& visit) {
  auto& [iteration, since_commit, tries, polished, broke, regularisation, overshoot, length, lengths, accepted,
         residual, change, merits, pairs, few] = p;
  visit(Saved{}, iteration, since_commit, tries, polished, broke, regularisation, overshoot, length, lengths, accepted,
        residual, change, merits, pairs, few);
}

void visit_fields(Either<StaticSystem> auto& s, auto&& visit) {
  auto& [stiffness, closed, of_water, work] = s;
  visit(Saved{}, stiffness, closed, of_water);
  visit(Found{}, work);
}

void visit_fields(Either<StaticIncrement> auto& n, auto&& visit) {
  auto& [under_way, trial, increments_left, increment_time, ends, elastic, began, base, progress, system] = n;
  visit(Saved{}, under_way, trial, increments_left, increment_time, ends, elastic, began, base, progress, system);
}

void visit_fields(Either<State> auto& s, auto&& visit) {
  auto& [bodies, contacts, supports, loads, schedule, ledger, counters, time_step, relaxation, increment] = s;
  visit(Hashed{}, bodies, contacts, schedule, supports, loads);
  visit(Saved{}, ledger, counters, time_step, relaxation, increment);
}

}  // namespace voussoir
