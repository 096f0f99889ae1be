#include "core/step/time_step.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "core/base/on_threads.hpp"
#include "core/contact/integrable.hpp"
#include "core/joint_laws/joint_law.hpp"

namespace voussoir {
namespace {

template <int Dim>
using Stiffness = FixedMatrix<freedoms<Dim>, freedoms<Dim>>;
// velocity of a point at lever arm r from the body's angular velocity
Vector<2> turning(const Vector<2>& r) {
  return {-r[1], r[0]};
}
Matrix<3> turning(const Vector<3>& r) {
  Matrix<3> x;
  x << 0, r[2], -r[1],  //
      -r[2], 0, r[0],   //
      r[1], -r[0], 0;
  return x;
}

// tangent stiffness at an overlap, Pa/m, or N/m when it is constant
struct Tangent {
  double normal, shear;
};

Tangent tangent(const JointProperties& p, double overlap) {
  if (p.laws.is_plain()) return {p.normal_stiffness, p.shear_stiffness};
  // as if bonded: the loss of a bond increases no stiffness
  const NormalAnswer answer = normal_answer(p, overlap, true);
  return {stiffest_normal(p, overlap), shear_stiffness_at(p, answer.stress)};
}

// factor by which stress stiffens a contact, relative to its joint's properties; 1 for the plain law
template <int Dim>
double stiffening(const JointProperties& p, const Contact<Dim>& c, std::span<const SubContact<Dim>> subs) {
  if (!p.laws.depends_on_stress()) return 1;
  double overlap = c.cells == 0 ? c.geometry.overlap : 0;
  for (const SubContact<Dim>& s : subs)
    if (s.area > 0) overlap = std::max(overlap, s.overlap);
  const Tangent now = tangent(p, overlap);
  return std::max(now.normal / p.normal_stiffness, p.shear_stiffness > 0 ? now.shear / p.shear_stiffness : 0);
}

double stiffest_joint(const std::vector<JointProperties>& properties, double area) {
  double stiffest = 0;
  for (const JointProperties& p : properties)
    stiffest = std::max(stiffest, std::max(p.normal_stiffness, p.shear_stiffness) * (p.constant_stiffness ? 1 : area));
  return stiffest;
}

// of run-time size in fixed storage: no memory is allocated, and one solver serves both dimensions
using FreeBlock = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, freedoms<3>, freedoms<3>>;

double largest_eigenvalue(const FreeBlock& stiffness, const FreeBlock& inertia) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<FreeBlock>(stiffness, inertia, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

// For a symmetric matrix without negative eigenvalues, at least the largest and at most 6 % more: the 32nd root of the
// sum of their 32nd powers, the trace of the matrix's power. If the second is nine tenths of the largest or less, 0.1 %
// more.
template <int Size>
double bound_of_largest_eigenvalue(FixedMatrix<Size, Size> s) {
  const double trace = s.trace();
  if (!(trace > 0)) return 0;
  s /= trace;
  for (int power = 1; power < 16; power *= 2)
    s = FixedMatrix<Size, Size>(s.lazyProduct(s));
  double root = s.squaredNorm();
  for (int power = 1; power < 32; power *= 2)
    root = std::sqrt(root);
  return trace * root;
}

// maps velocities for which the kinetic energy is half the sum of squares to a body's velocities; zero along restrained
// directions
template <int Dim>
Matrix<spin_freedoms<Dim>> spins_of_unit_energy(const Body<Dim>& body, const Rotation<Dim>& rotation) {
  if constexpr (Dim == 3)
    return matrix(rotation) * body.principal_axes * body.inertia.cwiseSqrt().cwiseInverse().asDiagonal();
  else
    return Matrix<1>(1 / std::sqrt(body.inertia[0]));
}

// the same by the eigenvalue itself, for a body that may rotate only about some axes: of M⁻¹K over its free directions
template <int Dim>
double largest_eigenvalue(const Body<Dim>& body, const Rotation<Dim>& rotation, const Stiffness<Dim>& k) {
  Stiffness<Dim> mass = Stiffness<Dim>::Zero();
  mass.template topLeftCorner<Dim, Dim>() = body.mass * Matrix<Dim>::Identity();
  if constexpr (Dim == 3) {
    const Matrix<3> axes = matrix(rotation) * body.principal_axes;
    mass.template bottomRightCorner<3, 3>() = axes * body.inertia.asDiagonal() * axes.transpose();
  } else {
    mass(Dim, Dim) = body.inertia[0];
  }
  std::array<int, freedoms<Dim>> free;
  int count = 0;
  for (int i = 0; i < Dim; ++i)
    if (body.free_translation[i]) free[count++] = i;
  for (int i = 0; i < spin_freedoms<Dim>; ++i)
    if (body.free_rotation[i]) free[count++] = Dim + i;
  if (count == 0) return 0;
  FreeBlock stiffness(count, count), inertia(count, count);
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      stiffness(i, j) = k(free[i], free[j]);
      inertia(i, j) = mass(free[i], free[j]);
    }
  return largest_eigenvalue(stiffness, inertia);
}

// upper bound of a body's largest squared frequency: of M⁻¹K over its free directions
template <int Dim>
double stiffest_square(const Body<Dim>& body, const Rotation<Dim>& rotation, const Stiffness<Dim>& k) {
  constexpr int S = spin_freedoms<Dim>;
  if (k.isZero(0)) return 0;  // in flight
  const auto turns = std::count(body.free_rotation.begin(), body.free_rotation.end(), true);
  if (turns > 0 && turns < S) return largest_eigenvalue<Dim>(body, rotation, k);
  Vector<Dim> moves;  // 1/√kg, 0 if it is held
  for (int i = 0; i < Dim; ++i)
    moves[i] = body.free_translation[i] ? 1 / std::sqrt(body.mass) : 0;
  Stiffness<Dim> scaled = Stiffness<Dim>::Zero();
  scaled.template topLeftCorner<Dim, Dim>() =
      moves.asDiagonal() * k.template topLeftCorner<Dim, Dim>() * moves.asDiagonal();
  if (turns > 0) {
    const Matrix<S> spins = spins_of_unit_energy(body, rotation);
    const auto mixed = scaled.template topRightCorner<Dim, S>();
    scaled.template topRightCorner<Dim, S>() = moves.asDiagonal() * (k.template topRightCorner<Dim, S>() * spins);
    scaled.template bottomLeftCorner<S, Dim>() = mixed.transpose();
    scaled.template bottomRightCorner<S, S>() = spins.transpose() * (k.template bottomRightCorner<S, S>() * spins);
  }
  return bound_of_largest_eigenvalue<freedoms<Dim>>(scaled);
}

// λ of a body: of its contacts, of bodies that may strike it with the stiffness `impact`, N/m, and of its other loads;
// `force`, N, moves it from rest, 0 once it moves
template <int Dim>
double stiffest(const Model<Dim>& model, int i, const Rotation<Dim>& rotation, const Stiffness<Dim>& stiffness,
                double impact, const BodyStiffness& loads, double force) {
  const Body<Dim>& body = model.bodies[i];
  double eigenvalue = stiffest_square<Dim>(body, rotation, stiffness);
  // A body in flight may hit something with its largest face. So may one that starts with a contact at a corner or an
  // edge hardly larger than rounding, 1e-28 of a face: that is not a joint yet, the force would compress it by more
  // than its width.
  const bool in_flight = eigenvalue == 0 || eigenvalue * body.mass * body.radius < force;
  if (in_flight && impact == 0)
    for (const Polytope<Dim>& part : body.parts)
      impact = std::max(impact, 2 * stiffest_joint(model.properties, part.largest_face));
  if (impact > 0) {
    // k (1/m + r²/I): one spring at the largest lever arm, the smallest moment of inertia
    const bool turns = std::any_of(body.free_rotation.begin(), body.free_rotation.end(), [](bool f) { return f; });
    eigenvalue += impact * (1 / body.mass + (turns ? body.radius * body.radius / body.inertia.minCoeff() : 0));
  }
  return eigenvalue + loads.translation / body.mass + loads.rotation / body.inertia.minCoeff();
}

// Adds one contact to a body at lever arm r, N/m: the shear stiffness in all directions, and the excess of the normal
// one along the normal. With X the point's velocity from the angular velocity, Jᵀ C J = shear [1 X; Xᵀ XᵀX] + more (n;
// r × n)(n; r × n)ᵀ.
template <int Dim>
void add(Stiffness<Dim>& k, const Tangent& now, double area, const Vector<Dim>& n, const Vector<Dim>& r) {
  constexpr int S = spin_freedoms<Dim>;
  const double shear = area * now.shear, more = area * (now.normal - now.shear);
  const auto x = turning(r);
  k.template topLeftCorner<Dim, Dim>().diagonal().array() += shear;
  k.template topRightCorner<Dim, S>() += shear * x;
  k.template bottomLeftCorner<S, Dim>() += shear * x.transpose();
  k.template bottomRightCorner<S, S>() += shear * (x.transpose() * x);
  FixedMatrix<freedoms<Dim>, 1> along;
  along << n, moment(r, n);
  for (int j = 0; j < freedoms<Dim>; ++j)
    k.col(j) += more * along[j] * along;
}

// m²: the overlap of two potential particles times the displacement of their contact point per rotation; the normal
// stiffness times it adds to the springs' resistance to rocking
template <int Dim>
double rocking(const Contact<Dim>& c) {
  return c.proof.kind == ProofKind::least_point ? c.geometry.overlap * c.proof.margin : 0;
}

// stiffer than its rating, or not rated yet
template <int Dim>
bool outgrown(const Model<Dim>& model, const ContactsState<Dim>& contacts, const Contact<Dim>& c) {
  if (c.status == ContactStatus::apart) return false;
  if (c.area_rated < 0) return true;
  if (model.particles && c.touching() && rocking(c) > c.area_rated) return true;
  return c.touching() && c.geometry.area * stiffening<Dim>(model.properties[c.properties], c,
                                                           subs_of(contacts, &c - contacts.list.data())) >
                             c.area_rated;
}

// Free bodies whose estimate is to be renewed.
struct BodiesToUpdate {
  std::vector<int> place;  // by body: index in `bodies`, or -1
  std::vector<int> bodies;

  void begin(std::size_t count) {
    place.assign(count, -1);
    bodies.clear();
    bodies.reserve(count);
  }
  template <int Dim>
  void add(const Model<Dim>& model, int body) {
    if (place[body] >= 0 || model.bodies[body].fixed) return;
    place[body] = static_cast<int>(bodies.size());
    bodies.push_back(body);
  }
};

// The contribution of a contact to one of the bodies to update: stiffness, or a possible impact. The first of its
// bodies that is updated rates the contact again.
template <int Dim>
void add_contact(const Model<Dim>& model, const ContactSettings& settings, const BodiesToUpdate& updated,
                 const BodiesState<Dim>& bodies, int place, int body, ContactsState<Dim>& contacts,
                 Stiffness<Dim>& stiffness, double& impact) {
  Contact<Dim>& c = contacts.list[place];
  if (c.status == ContactStatus::apart) return;
  const int ia = model.parts[c.part_a].body, ib = model.parts[c.part_b].body;
  const bool fixed_a = model.bodies[ia].fixed, fixed_b = model.bodies[ib].fixed;
  const bool updates_a = updated.place[ia] >= 0, updates_b = updated.place[ib] >= 0;
  // the image of a column's body moves with it
  const double factor = (fixed_a && !model.bodies[ia].image) || (fixed_b && !model.bodies[ib].image) ? 1 : 2;
  const auto rate = [&](double area) {
    if (body == ib && updates_a) return;
    // a body that is not updated relies on the rating so far
    const bool both = (updates_a || fixed_a) && (updates_b || fixed_b);
    c.area_rated = both ? area_margin * area : std::min(c.area_rated, area_margin * area);
  };
  if (!c.touching()) {
    const double face = std::min(model.polytope(c.part_a).largest_face, model.polytope(c.part_b).largest_face);
    rate(c.proof.kind == ProofKind::least_point ? 0 : face);  // its rocking is not known before
    impact += factor * stiffest_joint(model.properties, face);
    return;
  }
  const JointProperties& p = model.properties[c.properties];
  const auto subs = subs_of(std::as_const(contacts), static_cast<std::size_t>(place));
  rate(std::max(c.geometry.area * stiffening<Dim>(p, c, subs), rocking(c)));
  const Vector<Dim> apart = between(bodies.poses[ia], bodies.poses[ib]);
  // `gyration2` times the area: upper bound of the cell's contribution to rocking and twist about its own point
  const auto add_cell = [&](const Vector<Dim>& point, double overlap, double area, double gyration2) {
    const Tangent now = tangent(p, overlap);
    add<Dim>(stiffness, now, factor * area, c.geometry.normal, body == ia ? point : Vector<Dim>(point - apart));
    const double turning = factor * area * std::max(now.normal, now.shear) * gyration2;
    for (int i = Dim; i < freedoms<Dim>; ++i)
      stiffness(i, i) += turning;
  };
  if (is_integrated(settings, p))
    return add_cell(c.geometry.point, c.geometry.overlap, c.geometry.area, contacts.faces[place].gyration2);
  if (c.cells == 0)
    return add_cell(c.geometry.point, c.geometry.overlap, p.constant_stiffness ? 1 : c.geometry.area, rocking(c));
  const double unit = p.constant_stiffness ? c.geometry.area : 1;
  for (const SubContact<Dim>& s : subs)
    if (s.area > 0) add_cell(s.point, s.overlap, s.area / unit, s.gyration2);
}

// the estimate, renewed for these bodies
template <int Dim>
TimeStepEstimate estimate(const Model<Dim>& model, const Settings& settings, const DampingSettings& damping,
                          const BodiesToUpdate& updated, const BodiesState<Dim>& bodies, const LoadsState<Dim>& loads,
                          ContactsState<Dim>& contacts, TimeStep& time_step) {
  time_step.frequency.resize(model.bodies.size(), 0);
  each_on_threads(settings.threads, updated.bodies.size(), [&](int i) {
    const int body = updated.bodies[i];
    Stiffness<Dim> stiffness = Stiffness<Dim>::Zero();
    double impact = 0;  // N/m that may act at the radius
    for (const int place : contacts_of(contacts, body))
      add_contact(model, settings.contact, updated, bodies, place, body, contacts, stiffness, impact);
    const Motion<Dim>& motion = bodies.motions[body];
    const bool rests = motion.velocity.isZero(0) && motion.angular_momentum.isZero(0) && !loads.total.empty();
    const double force = rests ? loads.total[body].force.norm() : 0;
    time_step.frequency[body] =
        std::sqrt(stiffest(model, body, motion.rotation, stiffness, impact,
                           loads.stiffened.empty() ? BodyStiffness() : loads.stiffened[body], force));
  });
  double largest = 0;
  for (const double frequency : time_step.frequency)
    largest = std::max(largest, frequency);

  TimeStepEstimate estimate;
  const double xi = damping.viscous_ratio;
  estimate.limit = largest > 0 ? 2 / largest / (std::sqrt(1 + xi * xi) + xi) : std::numeric_limits<double>::infinity();
  if (settings.time.step)
    estimate.step = *settings.time.step;
  else if (largest > 0)
    estimate.step = settings.time.fraction * estimate.limit / std::sqrt(area_margin);
  return estimate;
}

}  // namespace

template <int Dim>
TimeStepEstimate estimate_time_step(const Model<Dim>& model, const Settings& settings, const DampingSettings& damping,
                                    const BodiesState<Dim>& bodies, const LoadsState<Dim>& loads,
                                    ContactsState<Dim>& contacts, TimeStep& time_step) {
  static thread_local BodiesToUpdate updated;
  updated.begin(model.bodies.size());
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    updated.add(model, static_cast<int>(b));
  time_step.frequency.clear();
  return estimate(model, settings, damping, updated, bodies, loads, contacts, time_step);
}

template <int Dim>
std::optional<TimeStepEstimate> renew_time_step(const Model<Dim>& model, const Settings& settings,
                                                const DampingSettings& damping, const BodiesState<Dim>& bodies,
                                                const LoadsState<Dim>& loads, ContactsState<Dim>& contacts,
                                                TimeStep& time_step) {
  if (time_step.frequency.empty())
    return estimate_time_step(model, settings, damping, bodies, loads, contacts, time_step);
  static thread_local std::vector<char> own_grown;
  static thread_local BodiesToUpdate updated;
  std::vector<char>& grown = own_grown;  // by contact: of this thread, filled by all
  grown.resize(contacts.list.size());
  each_on_threads(settings.threads, grown.size(),
                  [&](int i) { grown[i] = outgrown(model, contacts, contacts.list[i]); });
  updated.begin(model.bodies.size());
  for (std::size_t i = 0; i < grown.size(); ++i) {
    if (!grown[i]) continue;
    updated.add(model, model.parts[contacts.list[i].part_a].body);
    updated.add(model, model.parts[contacts.list[i].part_b].body);
  }
  if (updated.bodies.empty()) return {};
  return estimate(model, settings, damping, updated, bodies, loads, contacts, time_step);
}

void demand_time_step(const TimeStep& time_step) {
  if (!(time_step.allowed > 0))
    throw std::domain_error(
        "no contact and no joint property determines the time step: state time.step_s in the scene");
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                                  \
  template TimeStepEstimate estimate_time_step<Dim>(const Model<Dim>&, const Settings&, const DampingSettings&,    \
                                                    const BodiesState<Dim>&, const LoadsState<Dim>&,               \
                                                    ContactsState<Dim>&, TimeStep&);                               \
  template std::optional<TimeStepEstimate> renew_time_step<Dim>(                                                   \
      const Model<Dim>&, const Settings&, const DampingSettings&, const BodiesState<Dim>&, const LoadsState<Dim>&, \
      ContactsState<Dim>&, TimeStep&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
