#include "core/step/pair_stiffness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/on_threads.hpp"
#include "core/contact/integrable.hpp"
#include "core/contact/sensitivity.hpp"
#include "core/contact/sub_contacts.hpp"
#include "core/step/flight.hpp"
#include "core/step/joint_forces.hpp"
#include "core/step/neighbours.hpp"

namespace voussoir {
namespace {

// A difference uses this fraction of the overlap: the slope has an error of this size, and the soft modes of a stack
// are sums of stiff ones that nearly cancel (in the stack of the case overhang to a thousandth of the stiffest). It
// uses at least this fraction of the blocks' size, because below it the rounding of coordinates matters.
constexpr double of_overlap = 1e-6, of_size = 1e-13;

// of integrated contacts, over the bodies' extent
constexpr double of_integrals = 1e-14;

// narrower contacts rotate as if their width were this fraction of the size
constexpr double least_width = 1e-3;

// displacement by which a pair is moved together to test whether it is closed, over the smaller free body's inscribed
// radius
constexpr double probe_of_size = 1e-5;

template <int Dim>
bool is_free(const Model<Dim>& model, int body) {
  return !model.bodies[body].fixed && model.bodies[body].present;
}

template <int Dim>
bool turns(const Model<Dim>& model, int body) {
  const auto& free = model.bodies[body].free_rotation;
  return is_free(model, body) && std::find(free.begin(), free.end(), true) != free.end();
}

// of the smaller of a pair's free bodies, m
template <int Dim>
double size_of(const Model<Dim>& model, int a, int b) {
  const double size_a = model.bodies[a].size, size_b = model.bodies[b].size;
  if (!is_free(model, a)) return size_b;
  return is_free(model, b) ? std::min(size_a, size_b) : size_a;
}

void add(Counters& total, const KernelCounters& k) {
  total.contact_evaluations += k.evaluations;
  total.cold_starts += k.cold_starts;
  total.lp_solves += k.lp_solves;
  total.lp_pivots += k.lp_pivots;
  total.newton_iterations += k.newton_iterations;
  total.areas += k.areas;
  total.axis_hits += k.axis_hits;
}

// the pair after its second body, with pose `b`, has moved by `step` along one of its degrees of freedom, world axes
template <int Dim>
Pair<Dim> moved(Pair<Dim> pair, const CachedPose<Dim>& b, int freedom, double step) {
  if (freedom < Dim) {
    pair.offset += step * pair.axes.row(freedom).transpose();
    return pair;
  }
  Spin<Dim> turn = Spin<Dim>::Zero();
  turn[freedom - Dim] = step;
  pair.rotation = pair.axes.transpose() * matrix(turned(Rotation<Dim>{}, turn)) * b.axes;
  return pair;
}

// m or rad: step of a difference
template <int Dim>
double step_along(const Model<Dim>& model, const Contact<Dim>& c, const PairStiffness<Dim>& p, int freedom) {
  const double width = Dim == 3 ? std::sqrt(c.geometry.area) : c.geometry.area;
  const double size = size_of(model, p.body_a, p.body_b);
  const double way = std::max(of_overlap * c.geometry.overlap, of_size * size);
  return freedom < Dim ? way : way / std::max(width, least_width * size);
}

// m: step of the difference on an integrated face that is computed again: its error is the step over the overlap,
// beside the rounding of integrals over the step. It is one-sided: a joint that slips goes on slipping.
template <int Dim>
double step_on_face(const Model<Dim>& model, const Contact<Dim>& c, const PairStiffness<Dim>& p) {
  const double extent = std::max(model.bodies[p.body_a].radius, model.bodies[p.body_b].radius);
  const double overlap = c.geometry.overlap > 0 ? c.geometry.overlap : of_integrals * extent;
  return std::max(std::sqrt(of_integrals * extent * overlap), of_integrals * extent);
}

// contacts together in one batch of the kernel
constexpr int together = 40;

// the contact after its second body has moved by `step` along a degree of freedom, to first order
template <int Dim>
void move_contact(const ContactSensitivity<Dim>& sensitivity, const Matrix<Dim>& axes, int freedom, double step,
                  Contact<Dim>& c) {
  const Vector<Dim> way = step * sensitivity.point.col(freedom), turn = step * sensitivity.normal.col(freedom);
  c.proof.point += way;
  c.proof.axis += turn;
  c.geometry.point += axes * way;
  c.geometry.normal += axes * turn;
  c.geometry.overlap += step * sensitivity.overlap[freedom];
  c.geometry.area += step * sensitivity.area[freedom];
}

// Contacts at points after small motions of their second bodies, one after the other along each degree of freedom: by
// their sensitivities, or, if they have none, by the kernel.
template <int Dim>
struct MovedContacts {
  std::vector<Pair<Dim>> pairs, asked;  // all; those resolved by the kernel
  std::vector<Contact<Dim>> contacts;
  std::vector<double> steps;  // m, rad
  std::vector<Contact<Dim>*> places;
  std::vector<std::size_t> of_kernel;  // indices in `contacts`

  void find(const Model<Dim>& model, const Settings& settings, const BodiesState<Dim>& bodies,
            const ContactsState<Dim>& candidates, const JointHistories<Dim>& histories, const Climb& climb,
            std::span<const PairStiffness<Dim>> batch, KernelCounters& counters) {
    pairs.clear();
    asked.clear();
    contacts.clear();
    steps.clear();
    places.clear();
    of_kernel.clear();
    for (const PairStiffness<Dim>& p : batch) {
      const std::span<const JointRise<Dim>> rises = rises_of(histories, p.contact);
      const Contact<Dim>& c = candidates.list[p.contact];
      if (is_integrated(settings.contact, model.properties[c.properties])) continue;
      move(model, settings, bodies, c, drawn_by<Dim>(model, bodies, c, rises, climb), drawn_along<Dim>(rises), p);
    }
    for (const std::size_t k : of_kernel)
      places.push_back(&contacts[k]);
    resolve_pairs<Dim>(model, settings.contact, asked, places, counters);
  }

 private:
  void move(const Model<Dim>& model, const Settings& settings, const BodiesState<Dim>& bodies, const Contact<Dim>& c,
            double drawn, const Vector<Dim>& along, const PairStiffness<Dim>& p) {
    Pair<Dim> here = pair_of(model, bodies, c.part_a, c.part_b, QueryLevel::area);
    draw_together<Dim>(drawn, along, here);
    ContactSensitivity<Dim> sensitivity;
    const bool closed_form = c.proof.kind != ProofKind::least_point && has_sensitivity(settings.contact) &&
                             find_sensitivity<Dim>(here, settings.contact, c, sensitivity);
    const bool one_point = closed_form && c.cells == 0;  // whose pair is not asked again
    for (int f = 0; f < freedoms<Dim>; ++f) {
      steps.push_back(step_along(model, c, p, f));
      pairs.push_back(one_point ? here : moved(here, bodies.poses[p.body_b], f, steps.back()));
      contacts.push_back(c);
      if (f >= Dim && !turns(model, p.body_a) && !turns(model, p.body_b)) continue;  // held: its result is not used
      if (closed_form) {
        move_contact(sensitivity, here.axes, f, steps.back(), contacts.back());
      } else {
        of_kernel.push_back(contacts.size() - 1);
        asked.push_back(pairs.back());
      }
    }
  }
};

// A contact's joint from the histories of the increment's base.
template <int Dim>
struct JointFrom {
  const Model<Dim>& model;
  const Schedule& schedule;
  const JointStep& step;
  const CachedPose<Dim>&a, &b;
  const JointState<Dim>& history;
  std::span<const JointState<Dim>> sub_histories;
  std::span<const JointRise<Dim>> rises;
  double drawn;  // m

  JointFrom(const Model<Dim>& m, const Schedule& s, const JointStep& j, const BodiesState<Dim>& bodies,
            const Contact<Dim>& c, const JointHistories<Dim>& histories, const Climb& climb,
            const PairStiffness<Dim>& p)
      : model(m),
        schedule(s),
        step(j),
        a(bodies.poses[p.body_a]),
        b(bodies.poses[p.body_b]),
        history(histories.contacts[p.contact].history),
        sub_histories(subs_of(histories, p.contact)),
        rises(rises_of(histories, p.contact)),
        drawn(drawn_by<Dim>(m, bodies, c, rises, climb)) {}

  // `slip_normal`: of a face (face_forces.hpp)
  PairWrench<Dim> wrench(const Contact<Dim>& c, std::span<const SubContact<Dim>> subs,
                         const IntegratedContact<Dim>* face, Vector<3>* slip_normal = nullptr) const {
    return wrench_after(0, 0, c, subs, face, slip_normal);
  }
  // after a step of the second body along a degree of freedom
  PairWrench<Dim> wrench_after(int freedom, double by, const Contact<Dim>& then, std::span<const SubContact<Dim>> subs,
                               const IntegratedContact<Dim>* face, Vector<3>* slip_normal = nullptr) const {
    Spin<Dim> spin = b.spin;
    Vector<Dim> way = Vector<Dim>::Zero();
    if (freedom < Dim)
      way[freedom] = by;
    else
      spin[freedom - Dim] += by;
    const PairMotion<Dim> motion{between(a, b) + way, b.velocity - a.velocity + way, a.spin, spin,
                                 a.inverse_mass + b.inverse_mass};
    return joint_wrench<Dim>(model, schedule, step, then, subs, face, motion, history, sub_histories, rises, drawn,
                             slip_normal);
  }
};

// Whether the steps change a face contact so little that its sensitivity describes it: one that hardly presses may lose
// its area in a step, or have its force turned round.
template <int Dim>
bool is_slight(const Contact<Dim>& c, const IntegratedContact<Dim>& face, const FaceSensitivity<Dim>& s,
               const std::array<double, freedoms<Dim>>& steps) {
  constexpr double most_of_area = 0.5, least_cosine = -1 + 1e-6;
  for (int f = 0; f < freedoms<Dim>; ++f) {
    const Vector<Dim> force = face.force + steps[f] * s.force.col(f);
    if (!(std::abs(steps[f] * s.area[f]) < most_of_area * c.geometry.area) ||
        !(force.dot(face.normal) > least_cosine * force.norm()))
      return false;
  }
  return true;
}

// of an integrated face contact: moved by its sensitivity, or, where not faces alone press, computed again
template <int Dim>
void difference_of_face(const Model<Dim>& model, const BodiesState<Dim>& bodies, const ContactsState<Dim>& contacts,
                        const JointFrom<Dim>& joint, PairStiffness<Dim>& p) {
  constexpr int F = freedoms<Dim>;
  static thread_local std::vector<IntegratedContact<Dim>> faces(F);
  static thread_local std::vector<Contact<Dim>> moved_contacts(F);
  static thread_local std::vector<Pair<Dim>> pairs(F);
  const Contact<Dim>& c = contacts.list[p.contact];
  const IntegratedContact<Dim>& face = contacts.faces[p.contact];
  const Pair<Dim> here = pair_of(model, bodies, c.part_a, c.part_b, QueryLevel::area);
  Vector<3> slips = Vector<3>::Zero();
  p.wrench = joint.wrench(c, {}, &face, &slips);
  std::array<double, F> steps;
  for (int f = 0; f < F; ++f)
    steps[f] = step_along(model, c, p, f);
  FaceSensitivity<Dim> sensitivity;
  if (find_sensitivity<Dim>(here, c, sensitivity) && is_slight(c, face, sensitivity, steps)) {
    for (int f = 0; f < F; ++f) {
      moved_contacts[f] = c;
      faces[f] = face;
      move_by<Dim>(here, sensitivity, f, steps[f], moved_contacts[f], faces[f]);
    }
  } else {
    const double longer = step_on_face(model, c, p) / steps[0];
    for (int f = 0; f < F; ++f) {
      steps[f] *= longer;
      pairs[f] = moved(here, joint.b, f, steps[f]);
    }
    integrate_moved<Dim>(here, c, face, pairs, moved_contacts, faces);
  }
  for (int f = 0; f < F; ++f) {
    Vector<3> slips_then = slips;
    p.stiffness.col(f) =
        (p.wrench - joint.wrench_after(f, steps[f], moved_contacts[f], {}, &faces[f], &slips_then)) / steps[f];
  }
}

// of contacts [first, last) of the list
template <int Dim>
void difference(const Model<Dim>& model, const Settings& settings, const Schedule& schedule,
                const JointStep& joint_step, const BodiesState<Dim>& bodies, const ContactsState<Dim>& contacts,
                const JointHistories<Dim>& histories, std::span<PairStiffness<Dim>> batch, KernelCounters& counters) {
  constexpr int F = freedoms<Dim>;
  static thread_local MovedContacts<Dim> after;
  static thread_local std::vector<SubContact<Dim>> cells;
  const Climb climb = climb_over(model, joint_step.length);
  after.find(model, settings, bodies, contacts, histories, climb, batch, counters);

  cells.resize(sub_stride(contacts));
  std::size_t at = 0;  // in the contacts after motions
  for (PairStiffness<Dim>& p : batch) {
    const Contact<Dim>& c = contacts.list[p.contact];
    const JointFrom<Dim> joint(model, schedule, joint_step, bodies, c, histories, climb, p);
    p.apart = between(joint.a, joint.b);
    if (is_integrated(settings.contact, model.properties[c.properties])) {
      difference_of_face(model, bodies, contacts, joint, p);
      continue;
    }
    const int along = model.properties[c.properties].sub_contacts, count = sub_contact_count<Dim>(along);
    p.wrench = joint.wrench(c, subs_of(contacts, static_cast<std::size_t>(p.contact)), nullptr);
    for (int f = 0; f < F; ++f, ++at) {
      Contact<Dim>& then = after.contacts[at];
      std::span<SubContact<Dim>> subs;
      if (then.touching() && count > 0) {
        const std::size_t first = p.contact * sub_stride(contacts);
        std::copy_n(contacts.subs.begin() + static_cast<std::ptrdiff_t>(first), count, cells.begin());
        then.divided_face = c.divided_face;
        divide<Dim>(after.pairs[at], along, then, std::span(cells).first(count));
        subs = std::span(cells).first(then.cells);
      }
      p.stiffness.col(f) = (p.wrench - joint.wrench_after(f, after.steps[at], then, subs, nullptr)) / after.steps[at];
    }
  }
}

// the stiffness of one point of constant geometry
template <int Dim>
void add_point(const JointProperties& properties, const Vector<Dim>& normal, const Vector<Dim>& lever, double area,
               typename PairStiffness<Dim>::Block& stiffness) {
  const Matrix<Dim> along = normal * normal.transpose(), across = Matrix<Dim>::Identity() - along;
  FixedMatrix<Dim, freedoms<Dim>> motion;  // of the point with the second body
  motion.template leftCols<Dim>().setIdentity();
  for (int k = 0; k < spin_freedoms<Dim>; ++k)
    motion.col(Dim + k) = cross(Spin<Dim>(Spin<Dim>::Unit(k)), lever);
  stiffness += motion.transpose() *
               (area * (properties.normal_stiffness * along + properties.shear_stiffness * across)) * motion;
}

// and of a face around it: `polar` resists twist, at most as much as `rocking` resists rocking
template <int Dim>
void add_turning(const JointProperties& properties, const Vector<Dim>& normal, double polar, double rocking,
                 typename PairStiffness<Dim>::Block& stiffness) {
  if constexpr (Dim == 3) {
    const Matrix<3> along = normal * normal.transpose();
    stiffness.template bottomRightCorner<3, 3>() +=
        properties.shear_stiffness * polar * along +
        0.5 * properties.normal_stiffness * rocking * (Matrix<3>::Identity() - along);
  } else {
    stiffness(2, 2) += properties.normal_stiffness * rocking;
  }
}

// a history without force
template <int Dim>
JointState<Dim> unloaded(const Vector<Dim>& normal, const Vector<Dim>& point, double area) {
  JointState<Dim> history;
  history.normal = normal;
  history.point = point;
  history.area = area;
  return history;
}

}  // namespace

template <int Dim>
void find_pair_stiffness(const Model<Dim>& model, const Settings& settings, const Schedule& schedule,
                         const JointStep& joint_step, const BodiesState<Dim>& bodies,
                         const ContactsState<Dim>& contacts, const JointHistories<Dim>& histories,
                         const std::vector<int>& place, Counters& counters, std::vector<PairStiffness<Dim>>& list) {
  list.clear();
  for (std::size_t i = 0; i < contacts.list.size(); ++i) {
    const Contact<Dim>& c = contacts.list[i];
    const int a = model.parts[c.part_a].body, b = model.parts[c.part_b].body;
    if (!c.touching() || (place[a] < 0 && place[b] < 0)) continue;
    PairStiffness<Dim> pair;
    pair.contact = static_cast<int>(i);
    pair.body_a = a;
    pair.body_b = b;
    list.push_back(pair);
  }
  const int batches = (static_cast<int>(list.size()) + together - 1) / together;
  std::vector<KernelCounters> costs(batches);
  on_threads(settings.threads, batches, [&](int i) {
    const std::size_t first = static_cast<std::size_t>(i) * together;
    difference<Dim>(model, settings, schedule, joint_step, bodies, contacts, histories,
                    std::span(list).subspan(first, std::min<std::size_t>(together, list.size() - first)), costs[i]);
  });
  for (const KernelCounters& k : costs)
    add(counters, k);
}

template <int Dim>
void find_closed_joints(const Model<Dim>& model, const Settings& settings, const BodiesState<Dim>& bodies,
                        const ContactsState<Dim>& contacts, JointHistories<Dim>& histories, Counters& counters,
                        std::vector<PairStiffness<Dim>>& all_closed) {
  std::vector<Pair<Dim>> pairs;
  std::vector<Contact<Dim>> copies;
  std::vector<int> chosen;
  for (std::size_t i = 0; i < contacts.list.size(); ++i) {
    const Contact<Dim>& c = contacts.list[i];
    const int a = model.parts[c.part_a].body, b = model.parts[c.part_b].body;
    if (c.touching() || c.unanswered() || c.status == ContactStatus::apart ||
        (!is_free(model, a) && !is_free(model, b)))
      continue;
    if (!histories.contacts[i].history.normal.isZero(0)) continue;
    const double probe = probe_of_size * size_of(model, a, b);
    if (c.status == ContactStatus::separated && c.proof.margin > probe) continue;
    Pair<Dim> pair = pair_of(model, bodies, c.part_a, c.part_b, QueryLevel::area);
    const std::span<const JointRise<Dim>> rises = rises_of(std::as_const(histories), static_cast<int>(i));
    if (const JointRise<Dim>* const risen = highest(rises)) draw_together<Dim>(risen->rise, risen->normal, pair);
    Vector<Dim> axis =
        c.proof.kind == ProofKind::separating_axis ? Vector<Dim>(c.proof.axis) : Vector<Dim>(Vector<Dim>::Zero());
    if (axis.isZero(0)) axis = (pair.offset + pair.rotation * pair.b->centre - pair.a->centre).normalized();
    pair.offset -= 2 * probe * axis;
    chosen.push_back(static_cast<int>(i));
    pairs.push_back(pair);
    copies.emplace_back();
    copies.back().part_a = c.part_a;
    copies.back().part_b = c.part_b;
  }
  std::vector<Contact<Dim>*> places;
  for (Contact<Dim>& c : copies)
    places.push_back(&c);
  KernelCounters cost;
  resolve_pairs<Dim>(model, settings.contact, pairs, places, cost);
  add(counters, cost);

  const std::size_t stride = sub_stride(contacts);
  std::vector<SubContact<Dim>> cells(stride);
  for (std::size_t j = 0; j < chosen.size(); ++j) {
    Contact<Dim>& c = copies[j];
    if (!c.touching()) continue;
    const int joint = joint_of(model, c);
    const JointProperties& properties =
        model.properties[joint == no_joint ? model.default_properties : model.joints[joint].properties];
    PairStiffness<Dim> closed;
    closed.contact = chosen[j];
    closed.body_a = model.parts[c.part_a].body;
    closed.body_b = model.parts[c.part_b].body;
    closed.apart = between(bodies.poses[closed.body_a], bodies.poses[closed.body_b]);
    const Vector<Dim>& n = c.geometry.normal;
    const auto stand = [&](JointState<Dim>& history, const Vector<Dim>& point, double area) {
      history = unloaded<Dim>(n, point, area);
      add_point<Dim>(properties, n, point - closed.apart, area, closed.stiffness);
    };
    JointState<Dim>& history = histories.contacts[closed.contact].history;
    const int count = sub_contact_count<Dim>(properties.sub_contacts);
    if (is_integrated(settings.contact, properties)) {
      IntegratedContact<Dim> face;
      HalfSpaces<Dim> planes;
      find_nearest_faces<Dim>(pairs[j], c, planes);
      integrate_contact<Dim>(pairs[j], planes, c, face);
      stand(history, face.centre, c.geometry.area);
      history.normal = face.normal;
      history.polar = face.polar;
      add_turning<Dim>(properties, face.normal, face.polar, c.geometry.area * face.gyration2, closed.stiffness);
    } else if (count == 0) {
      stand(history, c.geometry.point, properties.constant_stiffness ? 1 : c.geometry.area);
    } else {
      std::fill(cells.begin(), cells.end(), SubContact<Dim>{});
      divide<Dim>(pairs[j], properties.sub_contacts, c, std::span(cells).first(count));
      history = unloaded<Dim>(n, c.geometry.point, c.geometry.area);
      histories.contacts[closed.contact].cells = count;
      histories.contacts[closed.contact].divided_face = c.divided_face;
      for (int k = 0; k < count; ++k)
        if (cells[k].area > 0)
          stand(histories.subs[closed.contact * stride + k], cells[k].point,
                properties.constant_stiffness ? cells[k].area / c.geometry.area : cells[k].area);
    }
    all_closed.push_back(closed);
  }
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                               \
  template void find_pair_stiffness<Dim>(const Model<Dim>&, const Settings&, const Schedule&, const JointStep&, \
                                         const BodiesState<Dim>&, const ContactsState<Dim>&,                    \
                                         const JointHistories<Dim>&, const std::vector<int>&, Counters&,        \
                                         std::vector<PairStiffness<Dim>>&);                                     \
  template void find_closed_joints<Dim>(const Model<Dim>&, const Settings&, const BodiesState<Dim>&,            \
                                        const ContactsState<Dim>&, JointHistories<Dim>&, Counters&,             \
                                        std::vector<PairStiffness<Dim>>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
