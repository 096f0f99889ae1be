// The contact polygon of faces and the integrals over it: against exact arithmetic, and as derivatives of the
// energy.
#include "core/contact/face_integral.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "core/contact/pair_geometry.hpp"
#include "core/testing/exact_referee.hpp"
#include "core/testing/shapes.hpp"

namespace voussoir::face_integral_test {
namespace {

using shapes::Random, shapes::uniform, shapes::integer, shapes::power_of_ten;

// promised: of areas and integrals themselves, of the extent for places, over the sine of the flattest side, and of
// needles, which are longer against their width than this, in proportion less
constexpr double promised = 1e-12, needle = 250;

template <int Dim>
struct Faces {
  HalfSpaces<Dim> planes;  // A's first, its first the face; B's likewise
  int faces_a = 0;
  double reach = 0;
};

// a side plane through `place` in the plane z = 0, its normal leaning by up to 45 degrees
template <int Dim>
HalfSpace<Dim> side(const Vector<Dim>& across, double distance, double lean) {
  const Vector<Dim> normal = (across + lean * Vector<Dim>::Unit(Dim - 1)).normalized();
  return {normal, normal.dot(distance * across)};
}

// one part's sides around a middle; flush: the same as those of the other part
template <int Dim>
void add_sides(Random& random, double radius, HalfSpaces<Dim>& planes) {
  const int count = Dim == 2 ? 2 : integer(random, 3, 8);
  const double turn = uniform(random, 0, 2 * std::numbers::pi), flatness = power_of_ten(random, -1.5, 0);
  for (int k = 0; k < count; ++k) {
    Vector<Dim> across = Vector<Dim>::Zero();
    if constexpr (Dim == 2) {
      across[0] = k == 0 ? 1 : -1;
    } else {
      const double angle = turn + 2 * std::numbers::pi * (k + uniform(random, 0, 0.3)) / count;
      across = {std::cos(angle), std::sin(angle), 0};
    }
    const double distance = radius * uniform(random, 0.3, 1) * (std::abs(across[0]) > 0.7 ? flatness : 1);
    planes.push_back(side<Dim>(across, distance, uniform(random, 0, 1) < 0.5 ? 0 : uniform(random, -1, 1)));
  }
}

// faces parallel, nearly parallel, or up to some 25 degrees apart; overlaps 1e-10 to 0.1 of their size; sizes 1 mm to
// 10 km
template <int Dim>
Faces<Dim> faces(Random& random) {
  const double size = power_of_ten(random, -3, 4);
  const double overlap = size * power_of_ten(random, -10, -1) * (integer(random, 0, 9) == 0 ? -1 : 1);
  const Vector<Dim> up = Vector<Dim>::Unit(Dim - 1);
  const auto leaning = [&](double angle) {
    Vector<Dim> n = up;
    n[0] = angle * (Dim == 2 ? (integer(random, 0, 1) == 0 ? -1 : 1) : uniform(random, -1, 1));
    if constexpr (Dim == 3) n[1] = angle * uniform(random, -1, 1);
    return Vector<Dim>(n.normalized());
  };
  const int kind = integer(random, 0, 3);
  const double angle = kind == 0   ? 0
                       : kind == 1 ? std::abs(overlap) / size * uniform(random, 0, 2)
                                   : power_of_ten(random, -9, -0.7);
  const double split = uniform(random, 0, 1);  // position between them of the point from which they are seen
  Faces<Dim> f;
  f.planes.push_back({leaning(angle), split * overlap});
  add_sides<Dim>(random, size, f.planes);
  f.faces_a = static_cast<int>(f.planes.size());
  f.planes.push_back({-leaning(angle), (1 - split) * overlap});
  if (integer(random, 0, 4) == 0) {
    for (int k = 1; k < f.faces_a; ++k)  // flush
      f.planes.push_back(f.planes[k]);
  } else {
    add_sides<Dim>(random, size, f.planes);
    Vector<Dim> shift = Vector<Dim>::Zero();  // so that some only just meet, and some do not
    shift[0] = size * uniform(random, -0.5, 0.5);
    for (std::size_t k = f.faces_a + 1; k < f.planes.size(); ++k)
      f.planes[k].offset += f.planes[k].normal.dot(shift);
  }
  // turned rigidly, seen from a point inside
  const Matrix<Dim> axes = matrix(shapes::orientation<Dim>(random));
  for (HalfSpace<Dim>& p : f.planes)
    p.normal = axes * p.normal;
  f.reach = 8 * size;
  return f;
}

exact::Planes exact_planes(const HalfSpaces<3>& planes) {
  return exact::planes_of(planes);
}
// a pair of the plane as one of space between lids, one thick
exact::Planes exact_planes(const HalfSpaces<2>& planes) {
  exact::Planes result;
  for (const HalfSpace<2>& p : planes)
    result.push_back({exact::point_of(p.normal), exact::Rational(p.offset)});
  const exact::Rational half(1, 2);
  result.push_back({{0, 0, 1}, half});
  result.push_back({{0, 0, -1}, half});
  return result;
}

struct Score {
  long long pressed = 0, open = 0, needles = 0;
  double worst = 0;  // of the promised accuracy
  std::string worst_is;

  void judge(double is, const exact::Quad& should, const exact::Quad& scale, double allowed, const std::string& what) {
    const double error = std::abs(exact::to_double((exact::Quad(is) - should) / scale)) / allowed;
    if (!(error <= worst)) {
      worst = error;
      worst_is = what;
    }
  }
};

template <int Dim>
void judge(std::uint64_t number, Score& score) {
  Random random(number);
  Faces<Dim> f = faces<Dim>(random);
  FaceIntegral<Dim> face;
  PressedPolygon polygon;
  // the promise is for planes seen from within the overlap
  if (integrate_face<Dim>(f.planes, f.faces_a, 0, f.faces_a, f.reach, face, polygon)) {
    const Vector<Dim> inside = face.pressure;
    for (HalfSpace<Dim>& p : f.planes)
      p = moved_origin(p, inside);
  }
  const exact::IntegratedContact truth = exact::pressed_face(exact_planes(f.planes), 0, f.faces_a);
  const bool found = integrate_face<Dim>(f.planes, f.faces_a, 0, f.faces_a, f.reach, face, polygon);
  if (!found) {
    ++score.open;
    EXPECT_TRUE(truth.area == 0) << "numbered " << number;
    return;
  }
  ++score.pressed;
  ASSERT_TRUE(truth.area > 0) << "numbered " << number;
  const double slender = Dim == 3 ? exact::to_double(truth.extent * truth.extent / truth.area) : 1;
  score.needles += slender > needle;
  const double allowed = promised / exact::to_double(truth.least_sine) * std::max(1.0, slender / needle);
  const auto named = [&](const char* what) { return fmt::format("{} of number {} in {}-D", what, number, Dim); };
  const exact::Quad polar = Dim == 3 ? truth.polar : truth.polar - truth.area / 12;
  score.judge(face.area, truth.area, truth.area, allowed, named("area"));
  score.judge(face.volume, truth.volume, truth.volume, allowed, named("volume"));
  score.judge(face.square, truth.square, truth.square, allowed, named("square"));
  score.judge(face.polar, polar, polar, allowed, named("polar"));
  for (int k = 0; k < Dim; ++k) {
    score.judge(face.centre[k], truth.centre[k], truth.extent, allowed, named("centre"));
    score.judge(face.pressure[k], truth.pressure[k], truth.extent, allowed, named("pressure"));
  }
}

Score judge_all(std::uint64_t first, std::uint64_t last) {
  Score score;
  for (std::uint64_t i = first; i < last; ++i)
    i % 10 < 7 ? judge<3>(i, score) : judge<2>(i, score);
  fmt::print("{} pressed, {} of them needles, {} open, {:.3g} of the promise: {}\n", score.pressed, score.needles,
             score.open, score.worst, score.worst_is);
  return score;
}

// ---- the force as a derivative --------------------------------------------------------------------------------------

// two boxes on each other, B's turned and moved by small amounts; seen from the origin
struct Boxes {
  FaceIntegral<3> face;
  PressedPolygon polygon;
  HalfSpaces<3> planes;
  bool pressed = false;
};
Boxes boxes(double tilt, const Vector<3>& way, const Vector<3>& turn) {
  Boxes result;
  result.planes = shapes::box<3>({-1, -1, -1}, {1, 1, 0});
  const Matrix<3> lean = Eigen::AngleAxisd(tilt, Vector<3>(0.6, 0.8, 0)).toRotationMatrix();
  const Matrix<3> moved = turn.norm() > 0
                              ? Matrix<3>(Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix())
                              : Matrix<3>(Matrix<3>::Identity());
  for (HalfSpace<3> p : shapes::box<3>({-0.7, -0.5, -0.01}, {1.5, 1.2, 1})) {
    p.normal = moved * lean * p.normal;
    p.offset += p.normal.dot(way);
    result.planes.push_back(p);
  }
  int top = -1, bottom = -1;
  for (int i = 0; i < 12; ++i) {
    if (i < 6 && result.planes[i].normal[2] > 0.9) top = i;
    if (i >= 6 && result.planes[i].normal[2] < -0.9) bottom = i;
  }
  result.pressed = integrate_face<3>(result.planes, 6, top, bottom, 10, result.face, result.polygon);
  return result;
}

// Along every degree of freedom, dE/k against -F·w - M·t: fully pressed and, from a tilt of 0.02 on, with an end that
// lifts off. Central differences of 1e-6 leave 1e-10 of the energy's third derivative, some 1.
TEST(FaceIntegral, ForceAndMomentAreTheDerivativeOfTheEnergy) {
  for (const double tilt : {0.0, 1e-3, 0.02, 0.2, 0.4}) {
    const Boxes at = boxes(tilt, Vector<3>::Zero(), Vector<3>::Zero());
    ASSERT_TRUE(at.pressed);
    for (int freedom = 0; freedom < 6; ++freedom) {
      const auto energy = [&](double along) {
        Vector<3> way = Vector<3>::Zero(), turn = Vector<3>::Zero();
        (freedom < 3 ? way : turn)[freedom % 3] = along;
        return 0.5 * boxes(tilt, way, turn).face.square;
      };
      constexpr double h = 1e-6;
      const double slope = (energy(h) - energy(-h)) / (2 * h);
      const double expected = -(freedom < 3 ? at.face.force : at.face.moment)[freedom % 3];
      EXPECT_NEAR(slope, expected, 1e-9) << "freedom " << freedom << ", tilt " << tilt;
    }
  }
}

TEST(FaceIntegral, AgreesWithExactArithmetic) {
  const Score score = judge_all(0, 4'000);
  EXPECT_GT(score.pressed, 2'000);
  EXPECT_GT(score.open, 200);
  EXPECT_LE(score.worst, 1) << score.worst_is;
}

TEST(FaceIntegralLong, AgreesWithExactArithmetic) {
  const Score score = judge_all(4'000, 1'020'000);
  EXPECT_GT(score.pressed, 500'000);
  EXPECT_LE(score.worst, 1) << score.worst_is;
}

}  // namespace
}  // namespace voussoir::face_integral_test
