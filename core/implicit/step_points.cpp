#include "core/implicit/step_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "core/contact/integrable.hpp"
#include "core/contact/integrated_contact.hpp"
#include "core/contact/separation.hpp"
#include "core/implicit/face_points.hpp"
#include "core/joint_laws/elastic_coulomb.hpp"
#include "core/step/face_forces.hpp"
#include "core/step/neighbours.hpp"

namespace voussoir {
namespace {

// m over the bodies' size: by how much a pair that may meet is drawn into each other, to see where
constexpr double probe_of_size = 1e-5;

// a direction of the first part's frame along which the pair is separated, and by how much
template <int Dim>
struct Separation {
  Vector<Dim> direction;
  double gap = -std::numeric_limits<double>::infinity();
};
template <int Dim>
Separation<Dim> separation_of(const Pair<Dim>& pair, const Contact<Dim>& c) {
  Separation<Dim> best;
  const auto look = [&](const Vector<Dim>& direction) {
    if (const double gap = gap_behind(pair, direction, support(*pair.a, direction)); gap > best.gap)
      best = {direction, gap};
  };
  if (c.proof.kind == ProofKind::separating_axis) look(c.proof.axis);
  for (const HalfSpace<Dim>& face : pair.a->faces)
    look(face.normal);
  for (const HalfSpace<Dim>& face : pair.b->faces)
    look(pair.rotation * -face.normal);
  return best;
}

double spin_about(const Vector<2>&, const Spin<2>&) {
  return 0;
}
double spin_about(const Vector<3>& n, const Spin<3>& spin) {
  return n.dot(spin);
}

// n × arm; 2-D: none
Vector<2> around(const Vector<2>&, const Vector<2>&) {
  return Vector<2>::Zero();
}
Vector<3> around(const Vector<3>& normal, const Vector<3>& arm) {
  return normal.cross(arm);
}

// Divides shear and twist of a contact's springs among its points in proportion to their normal forces: in proportion
// to their areas those that hardly press would slip in every step. `points`: of the contact.
template <int Dim>
void divide_springs(const JointState<Dim>& springs, const Vector<Dim>& centre, std::span<StepPoint<Dim>> points) {
  const auto pressed = [](const StepPoint<Dim>& p) { return p.law.normal * std::max(p.law.overlap, 0.0); };
  double sum = 0, polar = 0;
  Vector<Dim> of_pressure = Vector<Dim>::Zero();
  for (const StepPoint<Dim>& p : points) {
    sum += pressed(p);
    of_pressure += pressed(p) * (p.point - centre);
  }
  if (!(sum > 0)) return;
  of_pressure = centre + of_pressure / sum;
  for (const StepPoint<Dim>& p : points)
    polar += pressed(p) * (p.point - of_pressure).squaredNorm();
  const Vector<Dim>& n = points.front().normal;
  const double twist = springs.twist - moment_about<Dim>(n, Vector<Dim>(of_pressure - centre), springs.shear_force);
  for (StepPoint<Dim>& p : points) {
    p.from = pressed(p) / sum * springs.shear_force;
    if (polar > 0) p.from += pressed(p) * twist / polar * around(n, Vector<Dim>(p.point - of_pressure));
    p.force.shear = p.from;
  }
}

// Where friction was lowered before the step its shear is beyond Coulomb's disk. From there the midpoint rule would
// leave the spring as far within: the joint slips at once instead, as it does by explicit steps. J: what friction
// takes.
template <int Dim>
double slip_at_once(StepPoint<Dim>& p) {
  const double most = p.law.friction * p.law.normal * std::max(p.law.overlap, 0.0), size = p.from.norm();
  if (size <= most) return 0;
  p.from *= most / size;
  p.force.shear = p.from;
  return 0.5 * (size * size - most * most) / p.law.shear;
}

// one pair's points
template <int Dim>
class PointsOfPair {
 public:
  PointsOfPair(const Model<Dim>& m, const Settings& s, const Schedule& sched, const BodiesState<Dim>& b,
               const StepMotion<Dim>& mo, const Contact<Dim>& contact, int at, const Vector<Dim>& drawn_by)
      : model(m), settings(s), bodies(b), motion(mo), c(contact), place(at), drawn(drawn_by) {
    body_a = model.parts[c.part_a].body;
    body_b = model.parts[c.part_b].body;
    const int joint = joint_of(model, c);
    const int of_joint = joint == no_joint ? model.default_properties : model.joints[joint].properties;
    properties = &model.properties[of_joint];
    friction = std::tan(sched.friction[of_joint]);
    const double a = bodies.poses[body_a].inverse_mass, of_b = bodies.poses[body_b].inverse_mass;
    lighter = 1 / std::max(a, of_b);
    reduced = 1 / (a + of_b);
  }

  // of a face on a face, otherwise at the contact's own point; `before`: the history at the step's start
  void add(const Pair<Dim>& pair, const JointState<Dim>& before, StepPoints<Dim>& all) const {
    static thread_local FacePoints<Dim> face;
    find_faces(pair, face);
    StepContact<Dim> whole{.contact = place, .first = all.points.size(), .count = face.points.size(), .end = face.end};
    for (const FacePoint<Dim>& p : face.points)
      all.points.push_back(point_of(p, face));
    const double ks = properties->shear_stiffness;
    if (ks > 0 && !before.normal.isZero(0)) {
      const std::span<StepPoint<Dim>> own(all.points.begin() + whole.first, all.points.end());
      divide_springs(moved(before, face.normal, face.begin), face.begin.centre, own);
      whole.lost = held(before, ks);
      for (StepPoint<Dim>& p : own) {
        whole.lost -= 0.5 * p.from.squaredNorm() / p.law.shear;
        whole.slipped += slip_at_once(p);
      }
    }
    all.contacts.push_back(whole);
  }

 private:
  // in world axes
  void find_faces(const Pair<Dim>& pair, FacePoints<Dim>& face) const {
    static thread_local HalfSpaces<Dim> planes;
    Contact<Dim> near = c;
    if (near.proof.kind == ProofKind::interior_point) {
      find_nearest_faces<Dim>(pair, near, planes);
      if (find_face_points<Dim>(pair, near.proof.point, near.geometry.face_a, near.geometry.face_b,
                                relative_motion(pair), face)) {
        face.normal = pair.axes * face.normal;
        for (PressedArea<Dim>* area : {&face.all, &face.begin, &face.end}) {
          area->centre = pair.axes * area->centre;
          if (properties->constant_stiffness) area->area = area->area > 0 ? 1 : 0;
        }
        for (FacePoint<Dim>& p : face.points)
          p.place = pair.axes * p.place;
        return;
      }
    }
    const double overlap = c.geometry.overlap - c.geometry.normal.dot(Vector<Dim>(pair.axes * drawn));
    face.normal = c.geometry.normal;
    face.all = face.begin = face.end =
        PressedArea<Dim>{properties->constant_stiffness ? 1 : c.geometry.area, 0, c.geometry.point};
    face.points = {{c.geometry.point, overlap, face.all.area}};
  }

  // frame of the first body
  RelativeMotion<Dim> relative_motion(const Pair<Dim>& pair) const {
    const MeanMotion<Dim>&a = motion.mean[body_a], &b = motion.mean[body_b];
    const Vector<Dim> shift =
        b.velocity - a.velocity - cross(b.spin, between(bodies.poses[body_a], bodies.poses[body_b]));
    return {motion.h * (pair.axes.transpose() * shift), in_frame(pair.axes, Spin<Dim>(motion.h * (b.spin - a.spin))),
            drawn, motion.passed};
  }
  static Spin<2> in_frame(const Matrix<2>&, const Spin<2>& turn) { return turn; }
  static Spin<3> in_frame(const Matrix<3>& axes, const Spin<3>& turn) { return axes.transpose() * turn; }

  // the springs of the step's start, turned into the plane of the points and moved to the centre of what presses
  JointState<Dim> moved(const JointState<Dim>& before, const Vector<Dim>& normal,
                        const PressedArea<Dim>& pressed) const {
    JointState<Dim> h = before;
    const MeanMotion<Dim>&a = motion.mean[body_a], &b = motion.mean[body_b];
    const double since = motion.passed * motion.h;
    h.shear_force =
        carried(h.shear_force, h.normal, normal, since * 0.5 * spin_about(normal, Spin<Dim>(a.spin + b.spin)));
    const Vector<Dim> arm_b = h.point - between(bodies.poses[body_a], bodies.poses[body_b]);
    const Vector<Dim> apart_speed = b.velocity + cross(b.spin, arm_b) - a.velocity - cross(a.spin, h.point);
    const Vector<Dim> gone = since * (cross(a.spin, h.point) + 0.5 * apart_speed);
    change_area<Dim>(normal, pressed.centre - h.point - gone, pressed.area, pressed.polar, h);
    return h;
  }

  StepPoint<Dim> point_of(const FacePoint<Dim>& at, const FacePoints<Dim>& face) const {
    const Vector<Dim>& point = at.place;
    double sum = 0;
    for (const FacePoint<Dim>& p : face.points)
      sum += p.area;
    const double share = at.area / sum, whole = face.all.area;
    const JointProperties& p = *properties;
    StepPoint<Dim> found;
    found.contact = place;
    found.body_a = body_a;
    found.body_b = body_b;
    found.normal = face.normal;
    found.point = point;
    found.from_b = point - between(bodies.poses[body_a], bodies.poses[body_b]);
    found.area = whole * share;
    const double factor = p.constant_stiffness ? c.geometry.stiffness_factor : 1;
    PointStep& law = found.law;
    law.h = motion.h;
    law.normal = p.normal_stiffness * found.area * factor;
    law.shear = p.shear_stiffness * found.area;
    law.friction = friction;
    law.chi_normal = unresolved_share(p.normal_stiffness * whole * factor, lighter, motion.h);
    law.chi_shear = unresolved_share(p.shear_stiffness * whole, lighter, motion.h);
    law.rho_normal = softer_of(law.normal, share * lighter, motion.h);
    law.rho_shear = softer_of(std::max(law.shear, std::numeric_limits<double>::min()), share * lighter, motion.h);
    if (settings.damping.viscous_ratio > 0)
      law.dashpot = 2 * settings.damping.viscous_ratio * std::sqrt(law.normal * share * reduced);
    const double joint_dashpot =
        settings.damping.joint_ratio / (std::numbers::pi * settings.damping.joint_frequency);  // s: 2ξ/ω
    law.dashpot += joint_dashpot * law.normal;
    law.shear_dashpot = joint_dashpot * law.shear;
    law.overlap = at.overlap + motion.passed * found.normal.dot(found.motion(motion.mean));
    found.force.normal = std::max(law.normal * law.overlap, 0.0);
    return found;
  }

  const Model<Dim>& model;
  const Settings& settings;
  const BodiesState<Dim>& bodies;
  const StepMotion<Dim>& motion;
  const Contact<Dim>& c;
  const int place;
  const Vector<Dim> drawn;  // frame of the first body
  const JointProperties* properties;
  int body_a, body_b;
  double friction, lighter, reduced;
};

// m: by how much the second body may have come nearer to the first over the step, or gone away
template <int Dim>
double reach_of(const Model<Dim>& model, const StepMotion<Dim>& motion, int a, int b) {
  const MeanMotion<Dim>&of_a = motion.mean[a], &of_b = motion.mean[b];
  return motion.h * ((of_b.velocity - of_a.velocity).norm() + of_a.spin.norm() * model.bodies[a].radius +
                     of_b.spin.norm() * model.bodies[b].radius);
}

}  // namespace

template <int Dim>
void find_step_points(const Model<Dim>& model, const Settings& settings, const Schedule& schedule,
                      const BodiesState<Dim>& bodies, const ContactsState<Dim>& contacts,
                      const JointHistories<Dim>& before, const StepMotion<Dim>& motion, Counters& counters,
                      StepPoints<Dim>& all) {
  all.points.clear();
  all.contacts.clear();
  for (std::size_t i = 0; i < contacts.list.size(); ++i) {
    const Contact<Dim>& c = contacts.list[i];
    const int a = model.parts[c.part_a].body, b = model.parts[c.part_b].body, place = static_cast<int>(i);
    if (c.unanswered() || (bodies.poses[a].inverse_mass == 0 && bodies.poses[b].inverse_mass == 0)) continue;
    const JointState<Dim>& history = before.contacts[i].history;
    Pair<Dim> pair = pair_of(model, bodies, c.part_a, c.part_b, QueryLevel::area);
    if (c.touching()) {
      PointsOfPair<Dim>(model, settings, schedule, bodies, motion, c, place, Vector<Dim>::Zero())
          .add(pair, history, all);
      continue;
    }
    // also pairs that move as one but hardly have a gap: a block that is stopped stops those upon it in the same step
    const double probe = probe_of_size * std::min(model.bodies[a].size, model.bodies[b].size),
                 reach = probe + std::max(motion.passed, 1 - motion.passed) * reach_of(model, motion, a, b);
    const Separation<Dim> apart = separation_of(pair, c);
    if (!(apart.gap < reach)) continue;
    // drawn into each other to see where they meet
    const double drawn = std::max(apart.gap, 0.0) + probe;
    pair.offset -= drawn * apart.direction;
    Contact<Dim> found;
    found.part_a = c.part_a;
    found.part_b = c.part_b;
    Contact<Dim>* const one = &found;
    KernelCounters cost;
    resolve_pairs<Dim>(model, settings.contact, {&pair, 1}, {&one, 1}, cost);
    counters.contact_evaluations += cost.evaluations;
    if (!found.touching()) continue;
    PointsOfPair<Dim>(model, settings, schedule, bodies, motion, found, place, Vector<Dim>(drawn * apart.direction))
        .add(pair, history, all);
  }
}

std::string not_followed_implicitly(const JointProperties& properties, const ContactSettings& contact) {
  if (!is_integrated(contact, properties) && properties.sub_contacts > 1)
    return "they have sub_contacts; implicit steps take faces at points of their own: leave it out";
  if (!properties.laws.is_plain()) return "it has a law beyond elastic springs and Coulomb's friction";
  return {};
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                                    \
  template void find_step_points<Dim>(const Model<Dim>&, const Settings&, const Schedule&, const BodiesState<Dim>&,  \
                                      const ContactsState<Dim>&, const JointHistories<Dim>&, const StepMotion<Dim>&, \
                                      Counters&, StepPoints<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
