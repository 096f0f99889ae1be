#include "core/potential/contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/potential/first_point.hpp"
#include "core/potential/surface.hpp"

namespace voussoir {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// far more than any pair of the tests needs; a pair that reaches it has no result
constexpr int iteration_limit = 400;

// The descent for one λ ends when its remaining gain is this fraction of the gain of the next λ; with every change of λ
// half as much, so that the last ones are exact, down to the limit that rounding sets.
constexpr double inner_fraction = 0.1, least_inner_fraction = 1e-8;

// and the sign of f_A - f_B counts as that at the sum's least point only if far less remains
constexpr double sure_fraction = 1e-4;

// the remaining gain, as a fraction of the functions' terms, when the last Newton steps begin
constexpr double last_gap = 1e-12;
constexpr int last_steps = 8;  // each squares the error, until rounding ends them

// a bracket narrower than this fraction of the ratio has lost its root
constexpr double shut = 1e-6;

// log λ/(1-λ) changes by no more in one step: the model behind the step is a line in logarithms
constexpr double longest_change = 8;

// from a good point both conditions are met after a few steps; pairs that need more are better left to the careful
// search
constexpr int refine_limit = 12;

// as are pairs that do not come nearer: planes that count alternately
constexpr int most_longer_steps = 2;

// a step of this fraction of the bodies' reach is rounding
constexpr double settled = 2 * std::numeric_limits<double>::epsilon();

// Planes are considered up to this many radii r from the expected contact: the fewer the cheaper, as long
// as the point rarely leaves that distance.
constexpr double near_radii = 0.5;

// about e^x and log x, to first order exact at 0 and 1, from operations that have the same bits on every platform
double grown(double x) {
  double power = (16 + x) / (16 - x);
  for (int i = 0; i < 3; ++i)
    power *= power;
  return power;
}
double growth(double x) {
  const double root = std::sqrt(std::sqrt(std::sqrt(x)));
  return 16 * (root - 1) / (root + 1);
}

// of a gradient, over its weights and the coordinates: twice that of a slack, for a few planes
constexpr double gradient_rounding = 64 * std::numeric_limits<double>::epsilon();

// a ratio within the bracket, whose ends may be 0 and infinity, but not both
double between(double low, double high) {
  if (low == 0) return high / 4;
  return std::isfinite(high) ? std::sqrt(low) * std::sqrt(high) : 4 * low;
}

// Both functions at the point, and the weighted sum with the terms for Newton's steps.
template <int Dim>
struct Place {
  Place(const PlacedPotential<Dim>& of_a, const PlacedPotential<Dim>& of_b, const Vector<Dim>& point)
      : a(derivatives<Dim>(of_a, point)), b(derivatives<Dim>(of_b, point)) {}

  PotentialDerivatives<Dim> a, b;
  double lambda, sum;
  Vector<Dim> gradient, newton, across;  // of the sum; -H⁻¹ gradient; -H⁻¹ (∇f_A - ∇f_B): dx / dλ
  Matrix<Dim> hessian;
  double decrement;
  double spheres;   // the sum's curvature by the spheres, its minimum anywhere
  double q_a, q_b;  // f + 1 where Newton's step leads, by the gradients
};

// No point farther from the centre has f <= value: f is convex, so that along a ray it grows at least as fast beyond
// the surface, which lies within R, as before it.
template <int Dim>
class Reach {
 public:
  explicit Reach(const PlacedPotential<Dim>& all) : all_(all) {}
  double of_value(double value) {
    if (value <= 0) return all_.reach;
    if (at_centre_ == 0) at_centre_ = voussoir::value<Dim>(all_, all_.centre);
    return all_.reach * (1 - value / at_centre_);
  }

 private:
  const PlacedPotential<Dim>& all_;
  double at_centre_ = 0;  // f there, below 0 once it is known
};

// the gradients at the contact point
template <int Dim>
struct Slopes {
  Vector<Dim> a = Vector<Dim>::Zero(), b = Vector<Dim>::Zero();
};

// The planes that can count within a distance of a point. Those farther inside do not, as no normal is longer
// than 1.
template <int Dim>
class NearPlanes {
 public:
  NearPlanes(const PotentialPair<Dim>& pair, PotentialWorkspace<Dim>& workspace)
      : workspace_(workspace), distance_(near_radii * (pair.a->corner_radius + pair.b->corner_radius)) {
    take(workspace_.a, workspace_.near_a);
    take(workspace_.b, workspace_.near_b);
  }
  // whether the planes taken include all that count within this length of the point
  bool cover(const Vector<Dim>& point, double length) const {
    return held_ && (point - middle_).norm() + length < distance_;
  }
  // once it may have left the distance, planes are chosen again
  void hold(const Vector<Dim>& point) {
    if (cover(point, 0)) return;
    held_ = true;
    middle_ = point;
    choose(workspace_.a, workspace_.near_a);
    choose(workspace_.b, workspace_.near_b);
  }

 private:
  void take(const PlacedPotential<Dim>& all, PlacedPotential<Dim>& near) const {
    near.plane_weight = all.plane_weight;
    near.sphere_weight = all.sphere_weight;
    near.centre = all.centre;
    near.reach = all.reach;
  }
  void choose(const PlacedPotential<Dim>& all, PlacedPotential<Dim>& near) const {
    near.planes.clear();
    for (const HalfSpace<Dim>& plane : all.planes)
      if (signed_distance<Dim>(plane, middle_) > -1.01 * distance_) near.planes.push_back(plane);
  }

  PotentialWorkspace<Dim>& workspace_;
  Vector<Dim> middle_ = Vector<Dim>::Zero();
  double distance_;
  bool held_ = false;
};

template <int Dim>
class Search {
 public:
  // with all planes
  explicit Search(PotentialWorkspace<Dim>& workspace) : Search(workspace, workspace.a, workspace.b) {}
  // with only the planes that count around the contact
  Search(PotentialWorkspace<Dim>& workspace, const PlacedPotential<Dim>& a, const PlacedPotential<Dim>& b)
      : a_(a), b_(b), reach_a_(workspace.a), reach_b_(workspace.b), ray_(workspace.ray) {}

  // stops as soon as the query is proven
  void solve(const PotentialStart<Dim>& start, PotentialQuery query, PotentialContact<Dim>& contact,
             Slopes<Dim>& slopes) {
    contact.point = start.point;
    contact.ratio = start.ratio;
    double low = 0, high = infinity;  // of the ratio, as far as the signs of f_A - f_B show
    double fraction = inner_fraction;
    int foreseen = 0;
    while (contact.iterations < iteration_limit) {
      Place<Dim> at = look(contact);
      if (is_decided(query, contact)) return judge(contact);
      const double terms = 3 + at.a.value + at.b.value;
      const double mismatch = mismatch_of(at);
      // If no sphere curves the sum the bound is loose, and the gain predicted by Newton's step counts instead; twice,
      // because a point that has only just passed a plane has no information from behind it.
      foreseen = at.decrement + mismatch <= last_gap * terms ? foreseen + 1 : 0;
      if (contact.value - contact.bound <= last_gap * terms || foreseen > 1) return finish(at, contact, slopes);
      if (at.decrement <= sure_fraction * mismatch) (at.q_a > at.q_b ? low : high) = contact.ratio;
      // a sign from a point that had only just passed a plane was wrong if the bracket shuts before the end
      if (std::isfinite(high) && high - low <= shut * high) low = 0, high = infinity;
      const bool descended = at.decrement <= fraction * mismatch;
      if (foreseen == 0 && descended && change_ratio(at, low, high, contact)) {
        fraction = std::max(fraction / 2, least_inner_fraction);
      } else if (!descend(at, contact)) {
        // If planes hold the point, the bounds contain only rounding; Q itself shows the remaining gain.
        const double left = at.decrement + mismatch_of(at), q = 2 + at.a.value + at.b.value;
        if (descended || left <= last_gap * q || !change_ratio(at, low, high, contact))
          return finish(at, contact, slopes);
      }
    }
    contact.status = PotentialStatus::no_answer;
  }

  // whether the bounds prove the query
  static bool is_decided(PotentialQuery query, const PotentialContact<Dim>& contact) {
    if (query == PotentialQuery::least) return false;
    return contact.bound > contact.rounding ||
           (query == PotentialQuery::decision && contact.value + contact.rounding < 0);
  }

  void judge(PotentialContact<Dim>& contact) const {
    contact.status = contact.value + contact.rounding < 0   ? PotentialStatus::touching
                     : contact.bound - contact.rounding > 0 ? PotentialStatus::separated
                                                            : PotentialStatus::undecided;
  }

  // Newton's method on both conditions together from a start that should be near the result. False: it was not.
  bool refine(const PotentialStart<Dim>& start, PotentialQuery query, NearPlanes<Dim>& near,
              PotentialContact<Dim>& contact, Slopes<Dim>& slopes) {
    contact.point = start.point;
    contact.ratio = start.ratio;
    double lambda = start.ratio / (1 + start.ratio), of_b = 1 / (1 + start.ratio), previous = infinity;
    int foreseen = 0, longer_steps = 0;
    for (int i = 0; i < refine_limit && longer_steps <= most_longer_steps; ++i) {
      near.hold(contact.point);
      const Place<Dim> at = look_around(contact);
      const double least = std::max(at.a.value, at.b.value);
      if (query == PotentialQuery::decision || (query == PotentialQuery::overlap && least > 0)) {
        certify(at, contact);
        if (is_decided(query, contact)) return judge(contact), true;
      }
      const double terms = 3 + at.a.value + at.b.value;
      const Vector<Dim> difference = at.a.gradient - at.b.gradient;
      const double rate = difference.dot(at.across);
      if (!(rate < 0)) return false;
      const double change = -(at.a.value - at.b.value + difference.dot(at.newton)) / rate;
      const Vector<Dim> step = at.newton + change * at.across;
      const double length = step.norm();
      const double left = at.decrement + std::abs(at.q_a - at.q_b) * std::min(lambda, of_b);
      foreseen = left <= last_gap * terms ? foreseen + 1 : 0;
      if (length >= previous / 2 || length <= settled * (a_.reach + b_.reach)) {
        certify(at, contact);
        if (left <= last_gap * terms + contact.rounding) {
          judge(contact);
          slopes = {at.a.gradient, at.b.gradient};
          return foreseen > 1 || contact.value - contact.bound <= last_gap * terms + 2 * contact.rounding;
        }
      }
      longer_steps += length >= previous / 2;
      previous = length;
      lambda += change;
      of_b -= change;
      if (!(lambda > 0 && of_b > 0)) return false;
      contact.point += step;
      contact.ratio = lambda / of_b;
    }
    return false;
  }

 private:
  Place<Dim> look(PotentialContact<Dim>& contact) {
    const Place<Dim> at = look_around(contact);
    certify(at, contact);
    return at;
  }

  // the gain of another ratio at the end of Newton's step
  static double mismatch_of(const Place<Dim>& at) {
    return std::abs(at.q_a - at.q_b) * std::min(at.lambda, 1 - at.lambda);
  }

  void certify(const Place<Dim>& at, PotentialContact<Dim>& contact) {
    contact.value = std::max(at.a.value, at.b.value);
    contact.bound = bound_below(at, contact.point, contact.value);
    contact.rounding = value_rounding<Dim>(a_, contact.point, at.a) + value_rounding<Dim>(b_, contact.point, at.b);
  }

  Place<Dim> look_around(PotentialContact<Dim>& contact) const {
    ++contact.iterations;
    Place<Dim> at(a_, b_, contact.point);
    at.lambda = contact.ratio / (1 + contact.ratio);
    const double of_b = 1 / (1 + contact.ratio);
    at.sum = at.lambda * at.a.value + of_b * at.b.value;
    at.gradient = at.lambda * at.a.gradient + of_b * at.b.gradient;
    at.hessian = at.lambda * at.a.hessian + of_b * at.b.hessian;
    at.spheres = 2 * (at.lambda * a_.sphere_weight + of_b * b_.sphere_weight);
    foresee(at);
    return at;
  }

  // Newton's step by the Hessian, and its end
  static void foresee(Place<Dim>& at) {
    FixedMatrix<Dim, 2> right;
    right << at.gradient, at.a.gradient - at.b.gradient;
    const FixedMatrix<Dim, 2> solution = newton_solutions<Dim>(at.hessian, at.spheres, right);
    at.newton = solution.col(0);
    at.across = solution.col(1);
    at.decrement = -at.gradient.dot(at.newton);
    at.q_a = 1 + at.a.value + at.a.gradient.dot(at.newton);
    at.q_b = 1 + at.b.value + at.b.gradient.dot(at.newton);
  }

  // No point has a lower max(f_A, f_B) than this. Three bounds of the gain that the sum's slope still permits: by the
  // curvature of the spheres, its minimum, and by the extent of the points whose f_A (f_B) is no larger than the value
  // already found.
  double bound_below(const Place<Dim>& at, const Vector<Dim>& point, double value) {
    const double slope = at.gradient.norm();
    double gain = std::min(at.gradient.dot(point - a_.centre) + slope * reach_a_.of_value(value),
                           at.gradient.dot(point - b_.centre) + slope * reach_b_.of_value(value));
    if (at.spheres > 0) gain = std::min(gain, slope * slope / (2 * at.spheres));
    return std::max(at.sum - gain, -1.0);  // no f is lower
  }

  // False: rounding leaves no step. Planes that hold the point then count when the ratio changes: otherwise its step
  // would pass them.
  bool descend(Place<Dim>& at, PotentialContact<Dim>& contact) {
    const WeightedPotentials<Dim> sum{{&a_, &b_}, {at.lambda, 1 / (1 + contact.ratio)}};
    const Vector<Dim> step = descent_step<Dim>(sum, contact.point, at.gradient, at.hessian, at.spheres, ray_);
    const bool moves = contact.point + step != contact.point;
    contact.point += step;
    if (!moves) foresee(at);
    return moves;
  }

  // Newton's step to f_A = f_B, on log Q_A - log Q_B over log λ/(1-λ), Q = f + 1: a straight line for two spheres and
  // for two flat faces, and nearly one for all else. False: there is no such step here.
  bool change_ratio(const Place<Dim>& at, double low, double high, PotentialContact<Dim>& contact) const {
    if (!(at.q_a > 0 && at.q_b > 0)) return false;
    const double weights = at.lambda * (1 - at.lambda);
    const double rate = weights * (at.a.gradient.dot(at.across) / at.q_a - at.b.gradient.dot(at.across) / at.q_b);
    if (!(rate < 0)) return false;
    const double change = std::clamp(-growth(at.q_a / at.q_b) / rate, -longest_change, longest_change);
    double ratio = contact.ratio * grown(change);
    if (ratio <= low || ratio >= high) ratio = between(low, high);
    contact.point += at.newton + (ratio / (1 + ratio) - at.lambda) * at.across;
    contact.ratio = ratio;
    return true;
  }

  // Newton's method on both conditions together, as long as its steps become shorter and the bounds do not diverge
  void finish(Place<Dim> at, PotentialContact<Dim>& contact, Slopes<Dim>& slopes) {
    slopes = {at.a.gradient, at.b.gradient};
    double previous = infinity;
    for (int i = 0; i < last_steps; ++i) {
      const Vector<Dim> difference = at.a.gradient - at.b.gradient;
      const double rate = difference.dot(at.across);
      if (!(rate < 0)) break;
      const double change = -(at.a.value - at.b.value + difference.dot(at.newton)) / rate;
      const Vector<Dim> step = at.newton + change * at.across;
      const double lambda = at.lambda + change;
      if (!(step.norm() < previous) || !(lambda > 0 && lambda < 1)) break;
      previous = step.norm();
      PotentialContact<Dim> next = contact;
      next.point += step;
      next.ratio = lambda / (1 - lambda);
      at = look(next);
      if (next.value - next.bound > contact.value - contact.bound + next.rounding) break;
      contact = next;
      slopes = {at.a.gradient, at.b.gradient};
    }
    judge(contact);
  }

  const PlacedPotential<Dim>&a_, &b_;
  Reach<Dim> reach_a_, reach_b_;
  RayScratch& ray_;
};

// whether a gradient exceeds the rounding of coordinates
template <int Dim>
bool has_direction(const PlacedPotential<Dim>& potential, const Vector<Dim>& point, const Vector<Dim>& gradient) {
  const double size = potential.reach + point.norm() + potential.centre.norm();
  return gradient.norm() > gradient_rounding * size * (potential.plane_weight + potential.sphere_weight);
}

template <int Dim>
double length_through(const PlacedPotential<Dim>& a, const PlacedPotential<Dim>& b, const Vector<Dim>& point,
                      const Vector<Dim>& normal, double& longer) {
  const double ahead = distance_to_surface<Dim>(a, point, normal), behind = distance_to_surface<Dim>(b, point, -normal);
  longer = std::max(ahead, behind);
  return ahead + behind;
}

template <int Dim>
void find_overlap(const Slopes<Dim>& slopes, const NearPlanes<Dim>& near, double scale,
                  PotentialWorkspace<Dim>& workspace, PotentialContact<Dim>& contact) {
  const PlacedPotential<Dim>&a = workspace.a, &b = workspace.b;
  const bool covered = near.cover(contact.point, 0);
  contact.status = PotentialStatus::no_normal;
  if (!has_direction<Dim>(a, contact.point, slopes.a) || !has_direction<Dim>(b, contact.point, slopes.b)) return;
  const Vector<Dim> mean = slopes.a.normalized() - slopes.b.normalized();
  if (!(mean.norm() > 1)) return;  // at the least point the two are opposite
  contact.status = PotentialStatus::touching;
  contact.normal = mean.normalized();
  double longer = 0;
  if (covered)
    contact.overlap = length_through<Dim>(workspace.near_a, workspace.near_b, contact.point, contact.normal, longer);
  if (!near.cover(contact.point, longer))
    contact.overlap = length_through<Dim>(a, b, contact.point, contact.normal, longer);

  const double root = std::sqrt(1 + contact.value), of_b = 1 / (1 + contact.ratio);
  const double slope = of_b * (contact.ratio * slopes.a.norm() + slopes.b.norm()) / 2;  // both terms are equal
  contact.energy_overlap = -scale * contact.value / (1 + root);                         // S (1 - root)
  contact.energy_rate = scale * slope / (2 * root);
}

// without a start: the contact of the planes alone, else the point at which the enclosing spheres have equal values,
// with the weights that balance there
template <int Dim>
PotentialStart<Dim> begin(const PotentialPair<Dim>& pair, PotentialWorkspace<Dim>& workspace, bool& near) {
  const PlacedPotential<Dim>&a = workspace.a, &b = workspace.b;
  const FirstPoint<Dim> first = find_first_point<Dim>(a, b, workspace.columns);
  near = true;
  if (first.found && first.level > 0) return {first.point, first.ratio};
  near = !first.found;
  const double usual = energy_scale<Dim>(*pair.a) / energy_scale<Dim>(*pair.b);
  if (first.found) return {first.point, usual};
  return {a.centre + a.reach / (a.reach + b.reach) * (b.centre - a.centre), usual};
}

}  // namespace

template <int Dim>
double energy_scale(const PotentialShape<Dim>& shape) {
  const double k = shape.sphericity;
  return 1 / (std::sqrt((1 - k) * (1 - k / 2)) / shape.corner_radius + k / shape.sphere_radius);
}

template <int Dim>
PotentialContact<Dim> resolve(const PotentialPair<Dim>& pair, PotentialQuery query, PotentialWorkspace<Dim>& workspace,
                              const PotentialStart<Dim>& given) {
  place<Dim>(*pair.a, workspace.a);
  place<Dim>(*pair.b, pair.rotation, pair.offset, workspace.b);
  bool near = true;
  const PotentialStart<Dim> start = given.ratio > 0 ? given : begin<Dim>(pair, workspace, near);

  PotentialContact<Dim> contact;
  NearPlanes<Dim> planes(pair, workspace);
  Slopes<Dim> slopes;
  if (!near ||
      !Search<Dim>(workspace, workspace.near_a, workspace.near_b).refine(start, query, planes, contact, slopes))
    Search<Dim>(workspace).solve(start, query, contact, slopes);
  if (query == PotentialQuery::overlap && contact.status == PotentialStatus::touching)
    find_overlap<Dim>(slopes, planes, energy_scale<Dim>(*pair.a) + energy_scale<Dim>(*pair.b), workspace, contact);
  return contact;
}

template double energy_scale<2>(const PotentialShape<2>&);
template double energy_scale<3>(const PotentialShape<3>&);
template PotentialContact<2> resolve<2>(const PotentialPair<2>&, PotentialQuery, PotentialWorkspace<2>&,
                                        const PotentialStart<2>&);
template PotentialContact<3> resolve<3>(const PotentialPair<3>&, PotentialQuery, PotentialWorkspace<3>&,
                                        const PotentialStart<3>&);

}  // namespace voussoir
