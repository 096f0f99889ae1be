#include "core/implicit/advance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/implicit/load_bounds.hpp"
#include "core/implicit/step_system.hpp"
#include "core/load/time_factor.hpp"
#include "core/step/contacts.hpp"
#include "core/step/face_forces.hpp"
#include "core/step/loads.hpp"
#include "core/step/neighbours.hpp"
#include "core/step/open_sides.hpp"
#include "core/step/prescribed.hpp"

namespace voussoir {
namespace {

// Geometry of the points at half of the motion is found again so often at most.
constexpr int most_geometries = 12;

// A body turns by no more than this in a step, rad, and moves by no more than its radius.
constexpr double most_turn = 1;

// neighbours are listed for so many times the way of a step
constexpr double with_margin = 1.5;

// m: the inscribed radius of the smallest body that may move; infinity: there is none
template <int Dim>
double smallest_free(const Model<Dim>& model) {
  double size = std::numeric_limits<double>::infinity();
  for (const Body<Dim>& body : model.bodies)
    if (!body.fixed && body.present) size = std::min(size, body.size);
  return size;
}

template <int Dim>
class Advance {
 public:
  Advance(const Model<Dim>& m, const Settings& s, State<Dim>& now, double step, double geometry_within,
          StepPoints<Dim>& points)
      : model(m),
        settings(s),
        state(now),
        h(step),
        within(geometry_within),
        unknowns(m),
        mean(m.bodies.size()),
        found(points) {}

  // false: the equations were not solved, or a body goes too far; the state is spoilt
  bool carry_out() {
    begin();
    for (int k = 0; k < most_geometries; ++k) {
      const std::vector<MeanMotion<Dim>> last = mean;
      find_points(k == 0 ? 0 : 0.5);
      const std::vector<Load<Dim>>& loads = loads_at_half();
      const StepSolution solution = solve_step(model, unknowns, h, before, loads, plates, found.points, mean);
      ++state.counters.implicit_solutions;
      state.counters.implicit_iterations += solution.iterations;
      if (!solution.solved || goes_too_far()) return false;
      const bool settled = k > 0 && change_since(last) <= within;
      if (list_neighbours() || !settled) continue;
      end();
      return true;
    }
    return false;
  }

 private:
  void begin() {
    before = state.bodies.motions;
    for (std::size_t b = 0; b < before.size(); ++b) {
      const Body<Dim>& body = model.bodies[b];
      if (body.fixed || !body.present) continue;
      mean[b].velocity = before[b].velocity;
      mean[b].spin = angular_velocity(body, before[b]);
    }
    const double from = state.schedule.time - state.schedule.started;
    for (const PrescribedMotion<Dim>& p : model.prescribed) {
      if (p.repeats >= 0) continue;
      const Vector<Dim> velocity = path_of(p, from, from + h) / h;
      for (int k = 0; k < Dim; ++k)
        if (p.translation[k]) mean[p.body].velocity[k] = velocity[k];
      if (p.rotation) mean[p.body].spin = mean_of(p.factor, from, from + h) * p.angular_velocity;
    }
    repeat_images(model, mean);
    histories = histories_of(state.contacts);
    list_neighbours();
    begin_plates(from);
  }

  // The forces of plates, and what a column's outer image puts on it, are found with the motion of the step: they are
  // no loads meanwhile.
  void begin_plates(double from) {
    OpenSidesState<Dim>& open = state.loads.open_sides;
    for (ColumnLoad<Dim>& column : open.columns)
      column.now = {};
    for (std::size_t i = 0; i < open.plates.size(); ++i) {
      const OpenFace<Dim>& face = model.open_faces[i];
      open.plates[i].force.setZero();
      plates.push_back({&face,
                        open.plates[i].face,
                        open.plates[i].plate,
                        upgoing_between(model.open_sides[face.side].wave, from, from + h),
                        {},
                        {}});
    }
  }

  // the mean of its arms before and after the step, by which its displacement is exact
  Vector<Dim> arm_of(const OpenFace<Dim>& face, int body) const {
    const Rotation<Dim>& rotation = before[body].rotation;
    const Rotation<Dim> after = turned(rotation, turn_of_step<Dim>(mean[body].spin, h));
    return 0.5 * (matrix(rotation) + matrix(after)) * face.place;
  }

  // All pairs that may meet within the step, as seen from its start. True: the present motion goes beyond those that
  // were listed before.
  bool list_neighbours() {
    double way = 0;
    for (std::size_t b = 0; b < before.size(); ++b)
      if (!model.bodies[b].immobile() && model.bodies[b].present)
        way = std::max(way, h * (mean[b].velocity.norm() + model.bodies[b].radius * mean[b].spin.norm()));
    if (way <= listed) return false;
    listed = with_margin * way;
    Settings wide = settings;
    const double size = smallest_free(model);
    if (std::isfinite(size)) wide.contact.skin += 2 * listed / size;
    state.bodies.listed_at.clear();
    state.bodies.motions = before;
    cache_poses(model, settings.threads, state.bodies);
    find_neighbours(model, wide, state.bodies, state.contacts, state.counters);
    follow_list(state.contacts, histories);
    return true;
  }

  // after a part of the step
  void find_points(double passed) {
    for (std::size_t b = 0; b < before.size(); ++b)
      state.bodies.motions[b] = passed > 0 ? motion_at_half(before[b], mean[b], h) : before[b];
    state.contacts.kept.clear();
    set_histories(histories, state.contacts);
    cache_poses(model, settings.threads, state.bodies);
    find_contacts(model, settings, 0, state.bodies, state.contacts, state.counters);
    find_step_points<Dim>(model, settings, state.schedule, state.bodies, state.contacts, histories, {mean, h, passed},
                          state.counters, found);
    for (StepPlate<Dim>& p : plates) {
      p.arm = arm_of(*p.face, p.face->body);
      if (p.face->column >= 0) p.arm_of_column = arm_of(*p.face, p.face->column);
    }
  }

  // without the contacts' forces
  const std::vector<Load<Dim>>& loads_at_half() {
    state.contacts.loads.assign(state.contacts.list.size(), {});
    Schedule at_half = state.schedule;
    at_half.time += 0.5 * h;
    sum_loads(model, settings, at_half, state.bodies, state.contacts, state.supports, state.loads);
    return state.loads.total;
  }

  bool goes_too_far() const {
    return std::ranges::any_of(unknowns.bodies, [&](int b) {
      return h * mean[b].spin.norm() > most_turn || h * mean[b].velocity.norm() > model.bodies[b].radius;
    });
  }

  double change_since(const std::vector<MeanMotion<Dim>>& last) const {
    double most = 0;
    for (const int b : unknowns.bodies)
      most = std::max(most, h * ((mean[b].velocity - last[b].velocity).norm() +
                                 model.bodies[b].radius * (mean[b].spin - last[b].spin).norm()));
    return most;
  }

  // ---- the end of the step ------------------------------------------------------------------------------------------

  void end() {
    for (std::size_t b = 0; b < before.size(); ++b) {
      const Body<Dim>& body = model.bodies[b];
      if (!body.present || (body.fixed && !body.prescribed)) {
        state.bodies.motions[b] = before[b];
        continue;
      }
      state.bodies.motions[b] = motion_after(body, before[b], mean[b], h);
      if (body.fixed) state.bodies.motions[b].velocity = mean[b].velocity;
    }
    set_prescribed_velocities();
    place_images();
    add_works();
    keep_histories();
    calm();
    state.schedule.time += h;
    state.time_step.length = 0;
    cache_poses(model, settings.threads, state.bodies);
    find_open_sides(model, state.schedule, state.bodies, state.contacts, state.loads, state.ledger);
  }

  void place_images() {
    for (std::size_t i = 0; i < model.column_images.size(); ++i) {
      const ColumnImage<Dim>& image = model.column_images[i];
      place_image(model.bodies[image.body], state.bodies.motions[image.of_column], state.loads.open_sides.images[i],
                  state.bodies.motions[image.body]);
    }
  }

  // Of a prescribed motion: the mean velocity and half of the change of the velocity. With the velocity itself the
  // impulse of a body that follows would be left out of the joints' forces by a sixth of the change of the acceleration
  // times h, to first order in h.
  void set_prescribed_velocities() {
    const double from = state.schedule.time - state.schedule.started;
    for (const PrescribedMotion<Dim>& p : model.prescribed) {
      if (p.repeats >= 0) continue;
      const Vector<Dim> half = 0.5 * (velocity_at(p, from + h) - velocity_at(p, from));
      Motion<Dim>& m = state.bodies.motions[p.body];
      for (int k = 0; k < Dim; ++k)
        if (p.translation[k]) m.velocity[k] = mean[p.body].velocity[k] + half[k];
      if (!p.rotation) continue;
      const double change = 0.5 * (value_at(p.factor, from + h) - value_at(p.factor, from));
      m.angular_momentum = angular_momentum(model.bodies[p.body], m.rotation,
                                            Spin<Dim>(mean[p.body].spin + change * p.angular_velocity));
    }
  }

  // of all loads along the step, and of the forces at the points
  void add_works() {
    EnergyFlows& flows = state.ledger.energy.flows;
    std::vector<Load<Dim>> of_points(model.bodies.size());
    for (const StepPoint<Dim>& p : found.points) {
      const Vector<Dim> force = p.force.normal * p.normal + p.force.shear;
      of_points[p.body_b] += {force, moment(p.from_b, force)};
      of_points[p.body_a] += {-force, -moment(p.point, force)};
      each_beside(unknowns, p, p.point, p.from_b, [&](int unknown, double sign, const Vector<Dim>& arm) {
        const MeanMotion<Dim>& m = mean[unknowns.bodies[unknown]];
        flows[Source::free_field] += sign * h * force.dot(m.velocity + cross(m.spin, arm));
      });
    }
    for (const StepPlate<Dim>& p : plates) {
      const MeanMotion<Dim>& m = mean[p.face->body];
      flows[Source::plates] += h * p.step(mean, h).mean_force.dot(m.velocity + cross(m.spin, p.arm));
    }
    const auto work = [&](const std::vector<Load<Dim>>& loads) {
      double sum = 0;
      for (std::size_t b = 0; b < loads.size(); ++b)
        if (!model.bodies[b].immobile())
          sum += h * (loads[b].force.dot(mean[b].velocity) + loads[b].moment.dot(mean[b].spin));
      return sum;
    };
    for (std::size_t i = 0; i < load_count; ++i)
      if (static_cast<Source>(i) != Source::contacts && static_cast<Source>(i) != Source::prescribed_motion)
        flows.values[i] += source_table[i].motion * work(state.loads.by_source.values[i]);
    flows[Source::contacts] += work(of_points);
    for (const PrescribedMotion<Dim>& p : model.prescribed) {
      const Load<Dim> all{state.loads.total[p.body].force + of_points[p.body].force,
                          state.loads.total[p.body].moment + of_points[p.body].moment};
      for (int k = 0; k < Dim; ++k)
        if (p.translation[k]) flows[Source::prescribed_motion] -= h * all.force[k] * mean[p.body].velocity[k];
      if (p.rotation) flows[Source::prescribed_motion] -= h * all.moment.dot(mean[p.body].spin);
    }
  }

  void keep_histories() {
    for (Contact<Dim>& c : state.contacts.list)
      c.history = {};
    closed.clear();
    for (const StepContact<Dim>& whole : found.contacts)
      keep_history(whole);
  }

  // the rest of a pair's turns from half of the motion, where the points are: of the first body, and the mean of both
  struct SecondHalf {
    Matrix<Dim> of_a, both;
  };
  SecondHalf second_half(const StepPoint<Dim>& p) const {
    const auto half_turn = [&](const Spin<Dim>& spin) {
      return Matrix<Dim>(matrix(turned(Rotation<Dim>{}, Spin<Dim>(0.5 * turn_of_step<Dim>(spin, h)))));
    };
    const Spin<Dim>&a = mean[p.body_a].spin, &b = mean[p.body_b].spin;
    return {half_turn(a), half_turn(Spin<Dim>(0.5 * (a + b)))};
  }

  // m: of a centroid, when the bodies have moved
  Vector<Dim> place_after(int body) const {
    return model.bodies[body].reference + state.bodies.motions[body].displacement;
  }

  // of one contact: its points' springs become one again, whose stress is uniform but for a turn about the centre
  void keep_history(const StepContact<Dim>& whole) {
    EnergyFlows& flows = state.ledger.energy.flows;
    JointState<Dim> kept;
    double slipped = 0, elastic = 0, shear_stiffness = 0;
    ends.clear();
    if (whole.count == 0) return;
    const SecondHalf to_end = second_half(found.points[whole.first]);
    for (std::size_t k = whole.first; k < whole.first + whole.count; ++k) {
      const StepPoint<Dim>& p = found.points[k];
      const Vector<Dim> motion = p.motion(mean);
      const double overlap = p.overlap_after(motion);
      const PointEnd<Dim> end = end_of_step<Dim>(p.law, p.from, overlap, p.slip(motion), p.force);
      flows[Source::friction] += end.friction;
      flows[Source::dashpots] += end.dashpot;
      flows[Source::unresolved_springs] += end.unresolved;
      ends.push_back(end.shear);
      if (!(overlap > 0)) continue;
      kept.normal = p.normal;
      kept.shear_force += end.shear;
      slipped = std::max(slipped, end.plastic_slip);
      if (p.law.shear > 0) elastic += 0.5 * end.shear.squaredNorm() / p.law.shear;
      shear_stiffness = p.law.shear / p.area;
      // one place for both bodies: impulses at two places would turn them
      const Vector<Dim> arm = to_end.of_a * p.point;
      const Vector<Dim> from_b = arm + place_after(p.body_a) - place_after(p.body_b);
      closed.push_back({p.body_a, p.body_b, to_end.both * p.normal, arm, from_b, p.law.chi_normal * p.law.normal,
                        end.stuck ? p.law.chi_shear * p.law.shear : 0});
    }
    flows[Source::lost_area] += whole.lost + elastic;
    flows[Source::friction] += whole.slipped;
    if (kept.normal.isZero(0)) return;
    for (std::size_t k = 0; k < whole.count; ++k) {
      const StepPoint<Dim>& p = found.points[whole.first + k];
      kept.twist += moment_about<Dim>(kept.normal, Vector<Dim>(p.point - whole.end.centre), ends[k]);
    }
    kept.normal = to_end.both * kept.normal;
    kept.shear_force = to_end.both * kept.shear_force;
    kept.point = to_end.of_a * whole.end.centre;
    kept.area = whole.end.area;
    kept.polar = whole.end.polar;
    kept.plastic_slip = histories.contacts[whole.contact].history.plastic_slip + slipped;
    state.contacts.list[whole.contact].history = kept;
    flows[Source::lost_area] -= held(kept, shear_stiffness);
  }

  void calm() {
    if (closed.empty()) return;
    const Calmed calmed = calm_unresolved(model, unknowns, h, closed, state.bodies.motions);
    state.ledger.energy.flows[Source::prescribed_motion] += calmed.driven;
    state.ledger.energy.flows[Source::free_field] += calmed.beside;
    state.ledger.energy.flows[Source::unresolved_motion] += calmed.taken;
  }

  const Model<Dim>& model;
  const Settings& settings;
  State<Dim>& state;
  const double h, within;
  StepUnknowns<Dim> unknowns;
  std::vector<MeanMotion<Dim>> mean;  // by body
  std::vector<Motion<Dim>> before;
  JointHistories<Dim> histories;  // at the start, in the order of the last list
  double listed = -1;             // m: the way for which the neighbours are listed
  std::vector<StepPlate<Dim>> plates;
  StepPoints<Dim>& found;
  std::vector<ClosedPoint<Dim>> closed;
  std::vector<Vector<Dim>> ends;  // N: the shear of a contact's points after the step
};

}  // namespace

template <int Dim>
bool advance(const Model<Dim>& model, const Settings& settings, double h, double within, State<Dim>& state) {
  static thread_local StepPoints<Dim> points;  // one memory for all steps
  return Advance<Dim>(model, settings, state, h, within, points).carry_out();
}

#define VOUSSOIR_INSTANTIATE(Dim) \
  template bool advance<Dim>(const Model<Dim>&, const Settings&, double, double, State<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
