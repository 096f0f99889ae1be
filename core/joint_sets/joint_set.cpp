#include "core/joint_sets/joint_set.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "core/joint_sets/portable_math.hpp"
#include "core/joint_sets/random_stream.hpp"

namespace voussoir {
namespace {

// (1 + deviation²/mean²): from its logarithm follows the lognormal law, whose moments are mean^k growth^(k(k-1)/2)
double growth(const JointSet& set) {
  const double ratio = set.size_deviation / set.size_mean;
  return 1 + ratio * ratio;
}

double power(double x, int exponent) {
  double product = 1;
  for (int k = 0; k < exponent; ++k)
    product *= x;
  return product;
}

// E[size^k], k up to 3
double size_moment(const JointSet& set, int k) {
  const double plain = power(set.size_mean, k);
  constexpr double factorial[] = {1, 1, 2, 6};
  if (set.size_law == SizeLaw::exponential) return plain * factorial[k];
  if (set.size_law == SizeLaw::lognormal) return plain * power(growth(set), k * (k - 1) / 2);
  return plain;
}

// A size from the law weighted by size^k: of a lognormal law another lognormal one, of an exponential one Erlang's.
double weighted_size(const JointSet& set, int k, RandomStream& random) {
  if (set.size_law == SizeLaw::exponential) {
    double sum = 0;
    for (int i = 0; i <= k; ++i)
      sum += random.exponential();
    return set.size_mean * sum;
  }
  if (set.size_law == SizeLaw::lognormal) {
    const double deviation = std::sqrt(portable::log(growth(set)));
    const double median = set.size_mean * power(growth(set), k) / std::sqrt(growth(set));
    return median * portable::exp(deviation * random.normal());
  }
  return set.size_mean;
}

// distance of the outline's farthest point from its centre, over the size
template <int Dim>
double reach_over_size(const JointSet& set) {
  if (Dim == 2) return 0.5;
  if (set.shape == OutlineForm::rectangle) return std::sqrt(1 + set.elongation * set.elongation) / 2;
  return std::max(1.0, set.elongation) / 2;
}

// Joints whose centre is within radius + reach of the ball's centre, by powers of the size: the binomial terms of
// (radius + reach)^Dim times the volume of the unit ball and the density of centres.
template <int Dim>
std::array<double, Dim + 1> numbers_by_power(const JointSet& set, double radius) {
  constexpr std::array<double, Dim + 1> binomial = [] {
    if constexpr (Dim == 3)
      return std::array<double, 4>{1, 3, 3, 1};
    else
      return std::array<double, 3>{1, 2, 1};
  }();
  const double unit_ball = Dim == 3 ? 4 * std::numbers::pi / 3 : std::numbers::pi;
  const double density = stated_intensity<Dim>(set) / mean_measure<Dim>(set);
  std::array<double, Dim + 1> numbers;
  for (int k = 0; k <= Dim; ++k)
    numbers[k] = density * unit_ball * binomial[k] * power(radius, Dim - k) * power(reach_over_size<Dim>(set), k) *
                 size_moment(set, k);
  return numbers;
}

template <int Dim>
Vector<Dim> upward(const Vector<Dim>& n) {
  return n[Dim - 1] < 0 ? Vector<Dim>(-n) : n;
}

Vector<3> normal_of(double dip, double direction) {
  using namespace portable;
  return {sine(dip) * sine(direction), sine(dip) * cosine(direction), cosine(dip)};
}

// dip direction 90 degrees dips to the right, 270 to the left
Vector<2> trace_normal(const JointSet& set, double deviation) {
  const double dip = (set.dip_direction > std::numbers::pi ? -set.dip : set.dip) + deviation;
  return {portable::sine(dip), portable::cosine(dip)};
}

// A pole around the mean at an angle whose cosine has density ~ exp(κ cos): 1 - cos = -log(u + (1 - u) exp(-2κ))/κ.
Vector<3> fisher(const Vector<3>& mean, double constant, RandomStream& random) {
  // beyond this the weight of the far end is below the smallest double
  constexpr double no_weight = 350;
  const double far_end = constant < no_weight ? portable::exp(-2 * constant) : 0;
  const double u = random.uniform();
  const double fall = std::min(2.0, -portable::log(u + (1 - u) * far_end) / constant);
  const Vector<3> e1 = perpendicular(mean), e2 = mean.cross(e1);
  const Vector<2> turn = random.on_circle();
  return (1 - fall) * mean + std::sqrt(fall * (2 - fall)) * (turn[0] * e1 + turn[1] * e2);
}

template <int Dim>
Vector<Dim> draw_normal(const JointSet& set, RandomStream& random) {
  if constexpr (Dim == 2) {
    const double deviation = set.scatter == Scatter::normal ? set.dip_deviation * random.normal() : 0;
    return upward<2>(trace_normal(set, deviation));
  } else {
    if (set.scatter == Scatter::fisher)
      return upward<3>(fisher(normal_of(set.dip, set.dip_direction), set.fisher_constant, random).normalized());
    if (set.scatter == Scatter::none) return normal_of(set.dip, set.dip_direction);
    const double dip = set.dip + set.dip_deviation * random.normal();
    const double direction = set.dip_direction + set.dip_direction_deviation * random.normal();
    return upward<3>(normal_of(dip, direction));
  }
}

template <int Dim>
DrawnJoint<Dim> draw_finite(const JointSet& set, const Ball<Dim>& ball, const std::array<double, Dim + 1>& numbers,
                            double total, RandomStream& random) {
  DrawnJoint<Dim> joint;
  joint.normal = draw_normal<Dim>(set, random);
  double left = total * random.uniform();
  int weight = 0;
  while (weight < Dim && left >= numbers[weight])
    left -= numbers[weight++];
  joint.size = weighted_size(set, weight, random);
  const double reach = reach_over_size<Dim>(set) * joint.size;
  joint.point = ball.centre + (ball.radius + reach) * random.in_ball<Dim>();
  joint.outline.shape = set.shape;
  joint.outline.centre = joint.point;
  joint.outline.axes = plane_axes(joint.normal);
  joint.outline.half_sizes[0] = joint.size / 2;
  if constexpr (Dim == 3) joint.outline.half_sizes[1] = set.elongation * joint.size / 2;
  return joint;
}

template <int Dim>
DrawnJoint<Dim> persistent_joint(const JointSet& set, const Ball<Dim>& ball, double distance, RandomStream& random) {
  DrawnJoint<Dim> joint;
  joint.normal = draw_normal<Dim>(set, random);
  joint.point = ball.centre + distance * joint.normal;
  return joint;
}

// The distance of one of the equally spaced joints from the ball's centre, in spacings: that of the joint through the
// stated point, or random within one spacing.
template <int Dim>
double phase_of(const JointSet& set, const Ball<Dim>& ball, double distance, RandomStream& random) {
  if (set.point.empty()) return random.uniform();
  const Vector<Dim> mean = draw_normal<Dim>(set, random);  // without scatter
  return mean.dot(Eigen::Map<const Vector<Dim>>(set.point.data()) - ball.centre) / distance;
}

template <int Dim>
std::vector<DrawnJoint<Dim>> draw_persistent(const JointSet& set, const Ball<Dim>& ball, RandomStream& random) {
  std::vector<DrawnJoint<Dim>> joints;
  if (set.arrangement == Arrangement::poisson) {
    const long long count = random.poisson(expected_number<Dim>(set, ball.radius));
    for (long long i = 0; i < count; ++i)
      joints.push_back(persistent_joint<Dim>(set, ball, ball.radius * (2 * random.uniform() - 1), random));
    return joints;
  }
  const double distance = 1 / stated_intensity<Dim>(set), phase = phase_of<Dim>(set, ball, distance, random);
  const auto last = static_cast<long long>(std::floor(ball.radius / distance - phase));
  for (auto i = static_cast<long long>(std::ceil(-ball.radius / distance - phase)); i <= last; ++i)
    joints.push_back(persistent_joint<Dim>(set, ball, (static_cast<double>(i) + phase) * distance, random));
  return joints;
}

}  // namespace

template <int Dim>
double mean_projection(const JointSet& set) {
  const auto shrunk = [](double deviation) { return portable::exp(-deviation * deviation / 2); };
  if (set.scatter == Scatter::none) return 1;
  if (set.scatter == Scatter::fisher) {
    const double k = set.fisher_constant;
    // tanh(k/2) is (1 - exp(-k))/(1 + exp(-k)); beyond 700 it is 1 to the last bit
    const double decay = portable::exp(-std::min(k, 700.0));
    return 1 - (1 - decay) / (1 + decay) / k;
  }
  if (Dim == 2) return shrunk(set.dip_deviation);
  const double s = portable::sine(set.dip), c = portable::cosine(set.dip);
  return shrunk(set.dip_deviation) * (c * c + s * s * shrunk(set.dip_direction_deviation));
}

template <int Dim>
double stated_intensity(const JointSet& set) {
  assert(set.spacing.has_value() != set.intensity.has_value());
  if (set.intensity) return *set.intensity;
  // planes at equal distances keep them along each one's own normal
  const bool equal = set.size_law == SizeLaw::persistent && set.arrangement == Arrangement::equal;
  return set.persistence / (*set.spacing * (equal ? 1 : mean_projection<Dim>(set)));
}

template <int Dim>
double mean_measure(const JointSet& set) {
  if (Dim == 2) return set.size_mean;
  return (set.shape == OutlineForm::ellipse ? std::numbers::pi / 4 : 1) * set.elongation * size_moment(set, 2);
}

template <int Dim>
Ball<Dim> ball_around(const Polytope<Dim>& domain, const Vector<Dim>& origin) {
  Vector<Dim> low = domain.vertices.front(), high = low;
  for (const Vector<Dim>& v : domain.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  const Vector<Dim> middle = low + 0.5 * (high - low);
  double radius = 0;
  for (const Vector<Dim>& v : domain.vertices)
    radius = std::max(radius, (v - middle).norm());
  return {origin + middle, radius};
}

template <int Dim>
double expected_number(const JointSet& set, double radius) {
  if (set.size_law == SizeLaw::persistent) return 2 * radius * stated_intensity<Dim>(set);
  double total = 0;
  for (const double number : numbers_by_power<Dim>(set, radius))
    total += number;
  return total;
}

template <int Dim>
std::vector<DrawnJoint<Dim>> draw(const JointSet& set, const Ball<Dim>& ball) {
  RandomStream random(set.seed, set.name);
  if (set.size_law == SizeLaw::persistent) return draw_persistent<Dim>(set, ball, random);
  const std::array<double, Dim + 1> numbers = numbers_by_power<Dim>(set, ball.radius);
  const double total = expected_number<Dim>(set, ball.radius);
  const long long count = random.poisson(total);
  std::vector<DrawnJoint<Dim>> joints;
  for (long long i = 0; i < count; ++i)
    joints.push_back(draw_finite<Dim>(set, ball, numbers, total, random));
  return joints;
}

template <int Dim>
HalfSpace<Dim> plane_of(const DrawnJoint<Dim>& joint, const Vector<Dim>& origin) {
  return {joint.normal, joint.normal.dot(joint.point - origin)};
}

template double mean_projection<2>(const JointSet&);
template double mean_projection<3>(const JointSet&);
template double stated_intensity<2>(const JointSet&);
template double stated_intensity<3>(const JointSet&);
template double mean_measure<2>(const JointSet&);
template double mean_measure<3>(const JointSet&);
template Ball<2> ball_around<2>(const Polytope<2>&, const Vector<2>&);
template Ball<3> ball_around<3>(const Polytope<3>&, const Vector<3>&);
template double expected_number<2>(const JointSet&, double);
template double expected_number<3>(const JointSet&, double);
template std::vector<DrawnJoint<2>> draw<2>(const JointSet&, const Ball<2>&);
template std::vector<DrawnJoint<3>> draw<3>(const JointSet&, const Ball<3>&);
template HalfSpace<2> plane_of<2>(const DrawnJoint<2>&, const Vector<2>&);
template HalfSpace<3> plane_of<3>(const DrawnJoint<3>&, const Vector<3>&);

}  // namespace voussoir
