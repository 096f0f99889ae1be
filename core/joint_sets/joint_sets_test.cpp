// Drawn joint sets against closed forms. Bounds on statistics are 4.5 standard errors: by chance, one in 150,000 fails.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/joint_sets/joint_set.hpp"
#include "core/joint_sets/portable_math.hpp"
#include "core/joint_sets/random_stream.hpp"
#include "core/joint_sets/statistics.hpp"
#include "core/testing/shapes.hpp"
#include "text/angle.hpp"

namespace voussoir::joint_sets_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double errors = 4.5;

template <int Dim>
Polytope<Dim> box(const Vector<Dim>& low, const Vector<Dim>& high) {
  const HalfSpaces<Dim> planes = shapes::box<Dim>(low, high);
  return make_block<Dim>(planes, std::vector<int>(planes.size(), no_joint)).part;
}

JointSet finite_set() {
  JointSet set;
  set.name = "A";
  set.dip = 35 * degree;
  set.dip_direction = 110 * degree;
  set.size_law = SizeLaw::lognormal;
  set.size_mean = 2;
  set.size_deviation = 2;
  set.intensity = 0.4;
  return set;
}

JointSet persistent_set(double intensity) {
  JointSet set;
  set.name = "P";
  set.dip = 60 * degree;
  set.dip_direction = 200 * degree;
  set.intensity = intensity;
  return set;
}

// ---- numbers

TEST(PortableMath, IsThatOfTheLibraryToTwoRoundings) {
  shapes::Random random(1);
  constexpr double ulp = std::numeric_limits<double>::epsilon();
  for (int i = 0; i < 100'000; ++i) {
    const double x = shapes::power_of_ten(random, -300, 300), y = shapes::uniform(random, -700, 700),
                 angle = shapes::uniform(random, -100, 100), near = shapes::uniform(random, 0.5, 2);
    EXPECT_LE(std::abs(portable::log(x) - std::log(static_cast<long double>(x))), 2 * ulp * std::abs(std::log(x)));
    const long double log_near = std::log(static_cast<long double>(near));
    EXPECT_LE(std::abs(portable::log(near) - log_near), 2 * ulp * std::abs(log_near));
    const long double e = std::exp(static_cast<long double>(y));
    EXPECT_LE(std::abs(portable::exp(y) - e), 2 * ulp * e);
    EXPECT_LE(std::abs(portable::sine(angle) - std::sin(static_cast<long double>(angle))), 3e-16);
    EXPECT_LE(std::abs(portable::cosine(angle) - std::cos(static_cast<long double>(angle))), 3e-16);
  }
  EXPECT_EQ(portable::sine(0), 0);
  EXPECT_EQ(portable::cosine(0), 1);
  EXPECT_EQ(portable::log(1), 0);
  EXPECT_EQ(portable::exp(0), 1);
}

// mean and variance of n numbers against a law with these moments (kurtosis: of the fourth central moment)
void expect_moments(const std::function<double()>& draw, double mean, double variance, double kurtosis) {
  constexpr int n = 200'000;
  double sum = 0, squares = 0;
  for (int i = 0; i < n; ++i) {
    const double x = draw() - mean;
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / n, 0, errors * std::sqrt(variance / n));
  EXPECT_NEAR(squares / n, variance, errors * variance * std::sqrt((kurtosis - 1) / n));
}

TEST(RandomStream, HasTheMomentsOfItsLaws) {
  RandomStream random(3, "laws");
  expect_moments([&] { return random.uniform(); }, 0.5, 1.0 / 12, 1.8);
  expect_moments([&] { return random.exponential(); }, 1, 1, 9);
  expect_moments([&] { return random.normal(); }, 0, 1, 3);
  for (const double mean : {0.3, 7.0})
    expect_moments([&] { return static_cast<double>(random.poisson(mean)); }, mean, mean, 3 + 1 / mean);
  // in a ball r³ (in a disc r²) is uniform, and every direction equally likely
  expect_moments([&] { return std::pow(random.in_ball<3>().norm(), 3); }, 0.5, 1.0 / 12, 1.8);
  expect_moments([&] { return random.in_ball<2>().squaredNorm(); }, 0.5, 1.0 / 12, 1.8);
  expect_moments([&] { return random.in_ball<3>().normalized()[2]; }, 0, 1.0 / 3, 1.8);
  expect_moments([&] { return random.on_circle()[1]; }, 0, 0.5, 1.5);
}

// Computed apart from this program: the engine after Nishimura (2000), everything else in decimal arithmetic of 50
// digits. Any compiler and processor must produce these numbers but for a few roundings, and all of them the same.
TEST(RandomStream, GivesTheSameNumbersAsFiftyDigits) {
  boost::random::mt19937_64 engine;
  engine.discard(9999);
  EXPECT_EQ(engine(), 9981545732273789042u);  // as the C++ standard requires
  RandomStream random(7, "P");
  EXPECT_EQ(random.uniform(), 0.737561615436724);
  EXPECT_DOUBLE_EQ(random.exponential(), 0.03635534416422676);
  EXPECT_DOUBLE_EQ(random.normal(), 0.511363410207445);
  EXPECT_EQ(random.poisson(20), 19);

  JointSet set = finite_set();
  set.name = "bedding";
  set.seed = 42;
  set.scatter = Scatter::fisher;
  set.fisher_constant = 80;
  set.size_deviation = 1;
  set.intensity = 0.5;
  EXPECT_NEAR(expected_number<3>(set, 5), 117.708333333333333, 1e-11);
  const std::vector<DrawnJoint<3>> joints = draw<3>(set, {{1, 2, 3}, 5});
  ASSERT_EQ(joints.size(), 107u);
  const auto expect = [](const DrawnJoint<3>& joint, const Vector<3>& normal, double size, const Vector<3>& point) {
    EXPECT_LT((joint.normal - normal).norm(), 1e-15);
    EXPECT_NEAR(joint.size, size, 1e-14);
    EXPECT_LT((joint.point - point).norm(), 1e-14);
  };
  expect(joints.front(), {0.4521526149826371, -0.32143642676021666, 0.8320075939052402}, 0.8426443060115141,
         {-2.4995292475040367, 3.692845323534126, 0.298877378947312});
  expect(joints.back(), {0.6152978029534216, -0.303180809868287, 0.7276606422009521}, 0.7069246084243311,
         {-2.0493165414122987, 0.7287724835955527, 6.109401685343197});
}

TEST(RandomStream, OfOneSeedAndTwoNamesAreTwo) {
  const auto first = [](std::uint64_t seed, const char* name) { return RandomStream(seed, name).uniform(); };
  EXPECT_NE(first(0, "A"), first(1, "A"));
  EXPECT_NE(first(0, "A"), first(0, "B"));
  EXPECT_EQ(first(7, "A"), first(7, "A"));
}

// ---- measures

TEST(Outline, AreaInsideIsExact) {
  const Polytope<3> cube = box<3>({-1, -1, -1}, {1, 1, 1});
  const HalfSpace<3> level{Vector<3>(0, 0, 1), 0.25};
  Outline<3> disc{OutlineForm::ellipse, {0, 0, 0.25}, plane_axes(level.normal), {0.5, 0.5}, {}};
  EXPECT_NEAR(measure_inside(level, disc, cube), pi / 4, 1e-14);
  disc.centre = {1, 0, 0.25};
  EXPECT_NEAR(measure_inside(level, disc, cube), pi / 8, 1e-14);
  disc.centre = {1, 1, 0.25};
  EXPECT_NEAR(measure_inside(level, disc, cube), pi / 16, 1e-14);
  disc.centre = {1.2, 0, 0.25};  // a segment at 0.2 from the centre
  EXPECT_NEAR(measure_inside(level, disc, cube), 0.25 * std::acos(0.4) - 0.2 * std::sqrt(0.21), 1e-14);
  disc.centre = {1.4, 1.4, 0.25};  // beyond the corner, although its square is not
  EXPECT_EQ(measure_inside(level, disc, cube), 0);
  disc.half_sizes = {10, 5};
  EXPECT_NEAR(measure_inside(level, disc, cube), 4, 1e-13);
  disc.centre = {0, 0, 0.25};
  disc.half_sizes = {0.8, 0.4};
  EXPECT_NEAR(measure_inside(level, disc, cube), 0.32 * pi, 1e-14);

  Outline<3> square{OutlineForm::rectangle, {1, 0, 0.25}, plane_axes(level.normal), {0.5, 0.75}, {}};
  EXPECT_NEAR(measure_inside(level, square, cube), 0.5 * 1.5, 1e-14);
  Outline<3> triangle{OutlineForm::polygon, {0, 0, 0.25}, plane_axes(level.normal), {}, {{0, 0}, {3, 0}, {0, 3}}};
  EXPECT_NEAR(measure_inside(level, triangle, cube), 1, 1e-14);  // 1 + 1 <= 3: the cube's corner is inside it

  // the section of a cube across its diagonal is a regular hexagon of side sqrt(2)
  const HalfSpace<3> diagonal{Vector<3>(1, 1, 1).normalized(), 0};
  EXPECT_NEAR(measure_inside(diagonal, Outline<3>{}, cube), 3 * std::sqrt(3.0), 1e-13);

  const Polytope<2> square_2d = box<2>({-1, -1}, {1, 1});
  const HalfSpace<2> slanted{Vector<2>(-1, 1).normalized(), 0};
  EXPECT_NEAR(measure_inside(slanted, Outline<2>{}, square_2d), 2 * std::sqrt(2.0), 1e-14);
  const Outline<2> trace{OutlineForm::rectangle, {1, 1}, plane_axes(slanted.normal), {0.5}};
  EXPECT_NEAR(measure_inside(slanted, trace, square_2d), 0.5, 1e-14);
}

// ---- intensity

// over many seeds: the mean is the stated one, and the errors reported are the deviation between seeds
template <int Dim>
void expect_intensity(JointSet set, const Polytope<Dim>& domain, const Polytope<Dim>& probe, int seeds) {
  const Vector<Dim> origin = Vector<Dim>::Zero();
  double sum = 0, squares = 0, variance = 0, fourth = 0;
  const double stated = stated_intensity<Dim>(set);
  for (int seed = 0; seed < seeds; ++seed) {
    set.seed = seed;
    double inside = 0;
    for (const DrawnJoint<Dim>& joint : draw<Dim>(set, ball_around<Dim>(domain, origin))) {
      const double part =
          measure_inside(plane_of(joint, origin), outline_from(joint, origin), probe) / probe.mass.volume;
      inside += part;
      variance += part * part;
      fourth += part * part * part * part;
    }
    const double off = inside - stated;
    sum += off;
    squares += off * off;
  }
  variance /= seeds;
  fourth /= seeds;
  EXPECT_NEAR(sum / seeds, 0, errors * std::sqrt(variance / seeds));
  // of such a sum the second and fourth cumulants are those of the squares and fourth powers (Campbell)
  EXPECT_NEAR(squares / seeds / variance, 1, errors * std::sqrt((2 + fourth / (variance * variance)) / seeds));
}

// A corner of the domain, its middle, and all of it have the same intensity: no edge effect, though half of all joints'
// area belongs to joints larger than the domain.
TEST(Draw, IntensityIsTheSameEverywhereInTheDomain) {
  const Polytope<3> domain = box<3>({0, 0, 0}, {4, 4, 4});
  JointSet set = finite_set();
  for (const Polytope<3>& probe : {domain, box<3>({0, 0, 0}, {1, 1, 1}), box<3>({1.5, 1.5, 1.5}, {2.5, 2.5, 2.5})})
    expect_intensity<3>(set, domain, probe, 300);
  set.shape = OutlineForm::rectangle;
  set.elongation = 0.3;
  set.size_law = SizeLaw::exponential;
  set.scatter = Scatter::fisher;
  set.fisher_constant = 5;
  expect_intensity<3>(set, domain, box<3>({3, 3, 0}, {4, 4, 4}), 300);
  set.size_law = SizeLaw::constant;
  expect_intensity<3>(set, domain, box<3>({3, 0, 0}, {4, 1, 4}), 300);
  set = persistent_set(0.4);
  set.scatter = Scatter::fisher;
  set.fisher_constant = 1;
  expect_intensity<3>(set, domain, box<3>({3, 3, 3}, {4, 4, 4}), 300);
}

TEST(Draw, IntensityIsTheSameEverywhereInThePlane) {
  const Polytope<2> domain = box<2>({0, 0}, {4, 4});
  JointSet set = finite_set();
  set.dip_direction = 270 * degree;
  expect_intensity<2>(set, domain, box<2>({0, 3}, {1, 4}), 600);
  set.size_law = SizeLaw::exponential;
  expect_intensity<2>(set, domain, domain, 600);
  set.size_law = SizeLaw::persistent;
  set.scatter = Scatter::normal;
  set.dip_deviation = 20 * degree;
  expect_intensity<2>(set, domain, box<2>({0, 0}, {1, 1}), 600);
}

TEST(Draw, SpacingAndPersistenceMakeTheIntensity) {
  JointSet set = persistent_set(1);
  set.intensity.reset();
  set.spacing = 2;
  EXPECT_DOUBLE_EQ(stated_intensity<3>(set), 0.5);
  set.size_law = SizeLaw::constant;
  set.persistence = 0.6;
  EXPECT_DOUBLE_EQ(stated_intensity<3>(set), 0.3);
  set.scatter = Scatter::fisher;
  set.fisher_constant = 10;
  EXPECT_NEAR(stated_intensity<3>(set), 0.3 / (1 - std::tanh(5) / 10), 1e-15);
}

// ---- orientation

// the mean of |cos| over drawn joints against the closed form, which in turn is an integral
TEST(Draw, OrientationsScatterAsStated) {
  const Ball<3> ball{{0, 0, 0}, 10'000};
  JointSet set = persistent_set(1);
  const Vector<3> mean = upward_normal_3d(set.dip, set.dip_direction);
  const auto expect = [&](const char* what) {
    std::vector<double> projections;
    for (const DrawnJoint<3>& joint : draw<3>(set, ball)) {
      EXPECT_NEAR(joint.normal.norm(), 1, 1e-15);
      EXPECT_GE(joint.normal[2], 0);
      projections.push_back(std::abs(joint.normal.dot(mean)));
    }
    const Moments found = moments_of(projections);
    EXPECT_NEAR(found.mean.value, mean_projection<3>(set), errors * found.mean.error) << what;
  };
  set.scatter = Scatter::fisher;
  for (const double constant : {0.01, 1.0, 20.0, 500.0, 1e5}) {
    set.fisher_constant = constant;
    expect("fisher");
  }
  set.scatter = Scatter::normal;
  set.dip_deviation = 10 * degree;
  expect("dip");
  set.dip_direction_deviation = 15 * degree;
  expect("dip and direction");
}

// one upright disc of radius 1/2 in the middle of a cube of edge 2
TEST(Statistics, OfOneDiscAreItsAreaItsTracesAndTheLinesItMeets) {
  const Polytope<3> domain = box<3>({-1, -1, -1}, {1, 1, 1});
  JointSet set = persistent_set(1);
  set.dip = 90 * degree;
  set.dip_direction = 90 * degree;
  DrawnJoint<3> joint{Vector<3>(1, 0, 0), Vector<3>::Zero(), 1, {}};
  joint.outline = {OutlineForm::ellipse, joint.point, plane_axes(joint.normal), {0.5, 0.5}, {}};
  const SetStatistics<3> found =
      measure<3>(set, {joint}, ball_around<3>(domain, Vector<3>::Zero()), domain, Vector<3>::Zero());
  EXPECT_NEAR(found.intensity.value, pi / 4 / 8, 1e-15);
  EXPECT_NEAR(found.intensity.error, pi / 4 / 8, 1e-15);
  // sections normal to x, y, z: no trace in its own plane, a diameter in the others
  EXPECT_EQ(found.traces[0].value, 0);
  EXPECT_NEAR(found.traces[1].value, 1.0 / 4, 1e-9);
  EXPECT_NEAR(found.traces[2].value, 1.0 / 4, 1e-9);
  // 64 lines 1/4 apart, at odd eighths: 12 within the disc
  EXPECT_NEAR(found.scanned, 64 * 2, 1e-12);
  EXPECT_NEAR(found.frequency.value, 12.0 / 128, 1e-15);
  EXPECT_EQ(found.centred, 1);
  EXPECT_EQ(found.fisher_constant.value, 0);
}

TEST(Statistics, FindFishersConstant) {
  const Polytope<3> domain = box<3>({-50, -50, -50}, {50, 50, 50});
  JointSet set = finite_set();
  set.intensity = 0.05;
  set.scatter = Scatter::fisher;
  set.fisher_constant = 60;
  const Ball<3> ball = ball_around<3>(domain, Vector<3>::Zero());
  const SetStatistics<3> found = measure<3>(set, draw<3>(set, ball), ball, domain, Vector<3>::Zero());
  EXPECT_GT(found.inside, 1000);
  EXPECT_NEAR(found.fisher_constant.value, 60, errors * found.fisher_constant.error);
  EXPECT_NEAR(found.fisher_constant.error, 60 / std::sqrt(found.inside), 0.1 * found.fisher_constant.error);
  EXPECT_NEAR(found.intensity.value, 0.05, errors * found.intensity.error);
  EXPECT_NEAR(found.frequency.value, 0.05 * (1 - std::tanh(30) / 60), errors * found.frequency.error);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(found.traces[axis].value, found.stated_traces[axis], errors * found.traces[axis].error);
}

// ---- sizes

TEST(Statistics, SizesOfJointsCentredInTheDomainAreTheLaws) {
  const Polytope<3> domain = box<3>({0, 0, 0}, {20, 20, 20});
  JointSet set = finite_set();
  set.size_deviation = 1;
  set.intensity = 4;
  const auto sizes = [&](double mean, double deviation, double kurtosis) {
    const Ball<3> ball = ball_around<3>(domain, Vector<3>::Zero());
    const SetStatistics<3> found = measure<3>(set, draw<3>(set, ball), ball, domain, Vector<3>::Zero());
    const auto n = static_cast<double>(found.centred);
    EXPECT_GT(n, 3000);
    EXPECT_NEAR(found.size.value, mean, errors * deviation / std::sqrt(n));
    EXPECT_NEAR(found.size_deviation, deviation, errors * deviation * std::sqrt((kurtosis - 1) / (4 * n)) + 1e-12);
    // the number of centres, itself Poisson distributed
    const double centres = 4 / mean_measure<3>(set) * 8000;
    EXPECT_NEAR(n, centres, errors * std::sqrt(centres));
  };
  // kurtosis of a lognormal law: w^4 + 2 w^3 + 3 w^2 - 3 with w = 1 + (deviation/mean)²
  const double w = 1.25;
  sizes(2, 1, w * w * w * w + 2 * w * w * w + 3 * w * w - 3);
  set.size_law = SizeLaw::exponential;
  sizes(2, 2, 9);
  set.size_law = SizeLaw::constant;
  sizes(2, 0, 1);
}

// ---- spacing

// A rod along the joints' normal, as a single line through rock.
TEST(Statistics, LinesMeetARodsJoints) {
  const Polytope<3> rod = box<3>({-1, -1, 0}, {1, 1, 4000});
  JointSet set = persistent_set(0.5);
  set.dip = 0;
  const Ball<3> ball = ball_around<3>(rod, Vector<3>::Zero());
  const SetStatistics<3> found = measure<3>(set, draw<3>(set, ball), ball, rod, Vector<3>::Zero());
  EXPECT_NEAR(found.intensity.value, 0.5, errors * std::sqrt(0.5 / 4000));
  EXPECT_NEAR(found.intensity.error, std::sqrt(0.5 / 4000), 0.1 * std::sqrt(0.5 / 4000));
  // every joint crosses the full rod, so that every line meets it
  EXPECT_NEAR(found.frequency.value, found.intensity.value, 1e-12);
  EXPECT_NEAR(found.frequency.error, found.intensity.error, 1e-12);
}

TEST(Statistics, SpacingsOnScanlines) {
  const Polytope<2> domain = box<2>({0, 0}, {600, 600});
  JointSet set = persistent_set(0.5);
  set.dip = 0;
  set.dip_direction = 90 * degree;
  const Ball<2> ball = ball_around<2>(domain, Vector<2>::Zero());
  SetStatistics<2> found = measure<2>(set, draw<2>(set, ball), ball, domain, Vector<2>::Zero());
  EXPECT_NEAR(found.frequency.value, 0.5, errors * std::sqrt(0.5 / 600));
  // every line meets the same 300 joints: 300 spacings, each as often as there are lines
  const double n = 300;
  const Moments spacing = moments_of(found.spacings);
  EXPECT_NEAR(spacing.mean.value, 2, errors * 2 / std::sqrt(n));
  EXPECT_NEAR(spacing.deviation / spacing.mean.value, 1, errors / std::sqrt(n));

  set.arrangement = Arrangement::equal;
  found = measure<2>(set, draw<2>(set, ball), ball, domain, Vector<2>::Zero());
  EXPECT_NEAR(found.spacings.front(), 2, 1e-10);
  EXPECT_NEAR(found.spacings.back(), 2, 1e-10);
  EXPECT_EQ(found.inside, 300);
}

// One of the equally spaced joints passes through the stated point, for any seed and ball, and the others are spaced
// from there.
TEST(Equal, OneJointPassesThroughTheStatedPoint) {
  const Vector<3> point(12.25, -3.5, 7.75);
  for (const double radius : {5.0, 60.0})
    for (const std::uint64_t seed : {0u, 7u}) {
      JointSet set = persistent_set(0);
      set.intensity.reset();
      set.spacing = 2.5;
      set.arrangement = Arrangement::equal;
      set.point = {point[0], point[1], point[2]};
      set.seed = seed;
      const Ball<3> ball{{1, 2, 3}, radius};
      const std::vector<DrawnJoint<3>> joints = draw<3>(set, ball);
      const double through = joints.front().normal.dot(point - ball.centre);
      EXPECT_NEAR(static_cast<double>(joints.size()), 2 * radius / 2.5, 1);
      double nearest = 1;
      for (const DrawnJoint<3>& joint : joints) {
        const double distances = (joint.normal.dot(joint.point - ball.centre) - through) / 2.5;
        EXPECT_NEAR(distances, std::round(distances), 1e-12);
        EXPECT_LE((joint.point - ball.centre).norm(), radius * (1 + 1e-12));
        nearest = std::min(nearest, std::abs(distances));
      }
      EXPECT_EQ(nearest < 1e-12, std::abs(through) <= radius) << "it is drawn if it meets the ball";
    }
}

TEST(Statistics, SharesOfBlocks) {
  EXPECT_EQ(size_at_fraction({1, 2, 3, 4}, 0.1), 1);
  EXPECT_EQ(size_at_fraction({1, 2, 3, 4}, 0.5), 3);
  EXPECT_EQ(size_at_fraction({1, 2, 3, 4}, 0.9), 4);
  const Moments m = moments_of({1, 2, 3, 4});
  EXPECT_DOUBLE_EQ(m.mean.value, 2.5);
  EXPECT_DOUBLE_EQ(m.deviation, std::sqrt(5.0 / 3));
  EXPECT_DOUBLE_EQ(m.mean.error, std::sqrt(5.0 / 12));
}

}  // namespace
}  // namespace voussoir::joint_sets_test
