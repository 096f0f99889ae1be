// The sensitivity of a contact against central differences of the fully converged contact in 113 bits, whose planes are
// moved exactly (testing/exact_contacts).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/contact/pair_geometry.hpp"
#include "core/contact/sensitivity.hpp"
#include "core/testing/contacts.hpp"
#include "core/testing/exact_contacts.hpp"

namespace voussoir::sensitivity_test {
namespace {

using exact::Planes;
using exact::Quad;
using exact::Rational;
using exact::to_double;
using shapes::Random;

constexpr double ulp = std::numeric_limits<double>::epsilon();
constexpr ContactSettings settings{.newton_tolerance = 1e-9};

// The step of a difference over the overlap: its error is the square of that, and no other planes take part.
constexpr double difference_step = 1e-10;

// The error of the kernel's point is the stop rule's fraction of the region and that of rounding in a region as thin as
// the overlap (centre_test); its derivatives have the same relative error.
double left_open(double size, double overlap) {
  return settings.newton_tolerance + 16 * ulp * size / overlap;
}

template <int Dim>
struct Posed {
  Polytope<Dim> a, b;
  Matrix<Dim> rotation;
  Vector<Dim> offset;
  double size() const { return a.radius + b.radius; }
};

template <int Dim>
Polytope<Dim> random_shape(Random& random) {
  const Matrix<Dim> axes = matrix(shapes::orientation<Dim>(random));
  HalfSpaces<Dim> planes;
  if constexpr (Dim == 3) {
    const std::vector<shapes::Platonic> solids = shapes::platonic_solids(1);
    planes = solids[shapes::integer(random, 0, static_cast<int>(solids.size()) - 1)].planes;
  } else {
    planes = shapes::regular_polygon(shapes::integer(random, 3, 8), 1);
  }
  return shapes::block<Dim>(shapes::placed<Dim>(planes, axes, Vector<Dim>::Zero()));
}

// overlapping in any position, by a depth of 10^-8 to 10^-1 of their size
template <int Dim>
Posed<Dim> any_position(Random& random) {
  Posed<Dim> p{random_shape<Dim>(random), random_shape<Dim>(random), matrix(shapes::orientation<Dim>(random)), {}};
  const Vector<Dim> along = shapes::direction<Dim>(random);
  const double touching = contacts::distance_of_touching<Dim>(p.a, p.b, p.rotation, along);
  p.offset = (touching - shapes::power_of_ten(random, -8, -1)) * along;
  return p;
}

// cubes face on face, tilted within the overlap
template <int Dim>
Posed<Dim> face_on_face(Random& random) {
  const double depth = shapes::power_of_ten(random, -8, -1);
  Posed<Dim> p{shapes::block<Dim>(shapes::cube<Dim>(0.5)), shapes::block<Dim>(shapes::cube<Dim>(0.5)), {}, {}};
  p.rotation = matrix(turned(Rotation<Dim>{}, Spin<Dim>(0.3 * depth * Spin<Dim>::Ones())));
  p.offset = Vector<Dim>::Constant(0.2);
  p.offset[Dim - 1] = 1 - depth;
  return p;
}

// any position, of shapes whose faces may be two facets inclined by 10^-12 to 10^-2
template <int Dim>
Polytope<Dim> with_facets(const Polytope<Dim>& part, Random& random) {
  HalfSpaces<Dim> planes = part.faces;
  for (const HalfSpace<Dim>& face : part.faces) {
    if (shapes::integer(random, 0, 1) == 0) continue;
    const Vector<Dim> hinge = face.offset * face.normal + 0.1 * shapes::direction<Dim>(random);
    const Vector<Dim> on_face = hinge - signed_distance<Dim>(face, hinge) * face.normal;
    const double angle = shapes::power_of_ten(random, -12, -2);
    const Vector<Dim> normal = (face.normal + angle * shapes::direction<Dim>(random)).normalized();
    planes.push_back({normal, normal.dot(on_face)});
  }
  return shapes::block<Dim>(planes);
}
template <int Dim>
Posed<Dim> with_facets_in_any_position(Random& random) {
  Posed<Dim> p = any_position<Dim>(random);
  p.a = with_facets<Dim>(p.a, random);
  p.b = with_facets<Dim>(p.b, random);
  const Vector<Dim> along = shapes::direction<Dim>(random);
  const double touching = contacts::distance_of_touching<Dim>(p.a, p.b, p.rotation, along);
  p.offset = (touching - shapes::power_of_ten(random, -8, -1)) * along;
  return p;
}

template <int Dim>
std::vector<double> weights_of(const Posed<Dim>& p) {
  std::vector<double> weights;
  Pair<Dim> pair;
  pair.a = &p.a;
  pair.b = &p.b;
  assemble_weights<Dim>(pair, weights);
  if (weights.empty()) weights.assign(p.a.faces.size() + p.b.faces.size(), 1);
  return weights;
}

// The planes after a motion h of the second body along a degree of freedom: to first order in it, and by central
// differences to the second.
template <int Dim>
Planes moved(const Planes& planes, const Posed<Dim>& p, int freedom, double h) {
  Planes list = planes;
  for (std::size_t i = p.a.faces.size(); i < p.a.faces.size() + p.b.faces.size(); ++i) {
    exact::Plane& plane = list[i];
    if (freedom < Dim) {
      plane.offset += Rational(h) * plane.normal[freedom];
      continue;
    }
    const int about = Dim == 2 ? 2 : freedom - Dim, x = (about + 1) % 3, y = (about + 2) % 3;
    exact::Point change{};
    change[x] = -Rational(h) * plane.normal[y];
    change[y] = Rational(h) * plane.normal[x];
    plane.offset += exact::dot(change, exact::point_of(p.offset));
    for (int k = 0; k < 3; ++k)
      plane.normal[k] += change[k];
  }
  return list;
}

// the largest errors so far, over the permitted ones
struct Worst {
  double point = 0, normal = 0, overlap = 0, area = 0;
};

// by quantity a row of derivatives, those by turns over the pair's size
template <int Dim>
struct Derivatives {
  Eigen::Matrix<double, Dim, freedoms<Dim>> point, normal;
  Eigen::Matrix<double, 1, freedoms<Dim>> overlap, area;
};

template <int Dim>
Derivatives<Dim> by_differences(const Posed<Dim>& p, const Pair<Dim>& pair, const ContactGeometry<Dim>& g) {
  const Planes planes = exact::planes_of(pair);
  const double radius = settings.potential_radius * std::min(p.a.inscribed_radius, p.b.inscribed_radius);
  double lids = 1;
  if constexpr (Dim == 2) lids = 2 * exact::lid_height(pair);
  Derivatives<Dim> d;
  for (int f = 0; f < freedoms<Dim>; ++f) {
    const double lever = f < Dim ? 1 : p.size(), h = difference_step * g.overlap / lever;
    std::array<exact::ConvergedContact, 2> ends;
    for (const int side : {0, 1})
      ends[side] =
          exact::converged_contact(moved(planes, p, f, side ? h : -h), static_cast<int>(p.a.faces.size()),
                                   static_cast<int>(p.b.faces.size()), exact::point_of(g.point), radius, weights_of(p))
              .value();
    const auto slope = [&](const Quad& low, const Quad& high) {
      return to_double((high - low) / (2 * Quad(h))) / lever;
    };
    for (int k = 0; k < Dim; ++k) {
      d.point(k, f) = slope(ends[0].from_start[k], ends[1].from_start[k]);
      d.normal(k, f) = slope(ends[0].normal[k], ends[1].normal[k]);
    }
    d.overlap[f] = slope(ends[0].overlap, ends[1].overlap);
    d.area[f] = slope(ends[0].section.area, ends[1].section.area) / lids;
  }
  return d;
}

// 1/m: the error of a normal's derivative if the point's derivatives have an error of 1, and the point one of the
// region's width. A part's direction is the quotient of its gradient g = Σ w <r - s> a and |g|, and g changes as the
// point does.
template <int Dim>
double of_gradients(const Posed<Dim>& p, const ContactGeometry<Dim>& g) {
  const double radius = settings.potential_radius * std::min(p.a.inscribed_radius, p.b.inscribed_radius);
  const double width = g.overlap + (Dim == 3 ? std::sqrt(g.area) : g.area);
  double sum = 0;
  const std::vector<double> weights = weights_of(p);
  std::size_t counted = 0;
  for (const HalfSpaces<Dim>& planes : {p.a.faces, shapes::placed<Dim>(p.b.faces, p.rotation, p.offset)}) {
    Vector<Dim> gradient = Vector<Dim>::Zero();
    for (const HalfSpace<Dim>& plane : planes)
      gradient += weights[counted++] * std::max(radius + signed_distance(plane, g.point), 0.0) * plane.normal;
    const double length = gradient.norm();
    if (length > 0) sum += (1 + width / length) / length;  // else its direction is a face's
  }
  return sum;
}

template <int Dim>
void expect_derivatives(const Posed<Dim>& p, Worst& worst) {
  const contacts::Outcome<Dim> found = contacts::touch<Dim>(p.a, p.b, p.rotation, p.offset, settings);
  ASSERT_EQ(found.contact.status, ContactStatus::touching);
  const Pair<Dim> pair{&p.a, &p.b, Matrix<Dim>::Identity(), p.rotation, p.offset};
  ContactSensitivity<Dim> s;
  ASSERT_TRUE(find_sensitivity<Dim>(pair, settings, found.contact, s));
  const Derivatives<Dim> d = by_differences<Dim>(p, pair, found.contact.geometry);
  const double open = left_open(p.size(), found.contact.geometry.overlap);
  const double of_normal = (1 + d.point.cwiseAbs().maxCoeff()) * of_gradients(p, found.contact.geometry);
  const auto expect_near = [&](const auto& closed_form, const auto& difference, double more, double& least) {
    auto value = closed_form.eval();
    value.template rightCols<spin_freedoms<Dim>>() /= p.size();
    const double error = (value - difference).cwiseAbs().maxCoeff();
    const double allowed = open * (difference.cwiseAbs().maxCoeff() + more);
    EXPECT_LE(error, allowed);
    least = std::max(least, error / allowed);
  };
  expect_near(s.point, d.point, 0, worst.point);
  expect_near(s.normal, d.normal, of_normal, worst.normal);
  expect_near(s.overlap, d.overlap, 0, worst.overlap);
  expect_near(s.area, d.area, 0, worst.area);
}

template <int Dim>
void expect_all(Posed<Dim> (&pose)(Random&), unsigned seed, int count) {
  Random random(seed);
  Worst worst;
  for (int i = 0; i < count; ++i) {
    SCOPED_TRACE(fmt::format("{}-D, pair {}", Dim, i));
    expect_derivatives<Dim>(pose(random), worst);
  }
  testing::Test::RecordProperty("worst", fmt::format("point {:.2g}, normal {:.2g}, overlap {:.2g}, area {:.2g}",
                                                     worst.point, worst.normal, worst.overlap, worst.area));
}

TEST(Sensitivity, IsThatOfTheConvergedContactInAnyPosition) {
  expect_all<3>(any_position<3>, 901, 20);
  expect_all<2>(any_position<2>, 902, 70);
}

TEST(Sensitivity, IsThatOfTheConvergedContactFaceOnFace) {
  expect_all<3>(face_on_face<3>, 903, 30);
  expect_all<2>(face_on_face<2>, 904, 60);
}

TEST(Sensitivity, IsThatOfTheConvergedContactOfFacets) {
  expect_all<3>(with_facets_in_any_position<3>, 907, 8);
  expect_all<2>(with_facets_in_any_position<2>, 908, 30);
}

TEST(SensitivityLong, InManyPositions) {
  expect_all<3>(any_position<3>, 905, 2'000);
  expect_all<2>(any_position<2>, 906, 10'000);
  expect_all<3>(with_facets_in_any_position<3>, 909, 2'000);
  expect_all<2>(with_facets_in_any_position<2>, 910, 10'000);
}

// By hand: a cube on another with flush faces sinks and slides.
TEST(Sensitivity, OfACubeOnACube) {
  const Polytope<2> cube = contacts::unit_cube<2>();
  const double depth = 0.001, aside = 0.25;
  const contacts::Outcome<2> found = contacts::touch<2>(cube, cube, Vector<2>(aside, 1 - depth));
  const Pair<2> pair{&cube, &cube, Matrix<2>::Identity(), Matrix<2>::Identity(), Vector<2>(aside, 1 - depth)};
  ContactSensitivity<2> s;
  ASSERT_TRUE(find_sensitivity<2>(pair, settings, found.contact, s));
  EXPECT_NEAR(s.overlap[0], 0, contacts::exact);
  EXPECT_NEAR(s.overlap[1], -1, contacts::exact);
  EXPECT_NEAR(s.area[0], -1, contacts::exact);  // the overlap becomes narrower as the upper one slides off
  EXPECT_NEAR(s.area[1], 0, contacts::exact);
  EXPECT_NEAR(s.normal(0, 2), -0.5, contacts::point_tolerance);  // half the upper one's turn
}

TEST(Sensitivity, BelongsToThePublishedContactAlone) {
  EXPECT_TRUE(has_sensitivity({}));
  EXPECT_FALSE(has_sensitivity({.point = ContactPoint::centroid}));
  EXPECT_FALSE(has_sensitivity({.point = ContactPoint::central_path, .normal = ContactNormal::multipliers}));
  EXPECT_FALSE(has_sensitivity({.overlap = OverlapSearch::bracketing}));
}

}  // namespace
}  // namespace voussoir::sensitivity_test
