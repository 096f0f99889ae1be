// The sensitivity of a face on a face against central differences of the integrated contact itself.
#include "core/contact/face_sensitivity.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/contact/integrated_contact.hpp"
#include "core/testing/shapes.hpp"

namespace voussoir::face_sensitivity_test {
namespace {

using shapes::Random, shapes::uniform, shapes::integer, shapes::power_of_ten;

template <int Dim>
struct Posed {
  Polytope<Dim> a, b;
  Pair<Dim> pair;
};

// a box on a box, the upper one shifted and tilted within its overlap; `flush`: sides above sides, within the overlap
template <int Dim>
void pose(Random& random, double depth, bool flush, Posed<Dim>& p) {
  const auto box = [&](bool same) {
    Vector<Dim> half = Vector<Dim>::Constant(0.5);
    for (int k = 0; k + 1 < Dim; ++k)
      half[k] = same ? 0.5 : uniform(random, 0.3, 0.7);
    HalfSpaces<Dim> planes;
    for (int k = 0; k < Dim; ++k)
      for (const double sign : {-1.0, 1.0})
        planes.push_back({sign * Vector<Dim>::Unit(k), half[k]});
    return shapes::block<Dim>(planes);
  };
  p.a = box(flush);
  p.b = box(flush);
  Spin<Dim> tilt;
  for (Eigen::Index k = 0; k < tilt.size(); ++k)
    tilt[k] = depth * uniform(random, -1.5, 1.5);
  if (Dim == 3 && !flush) tilt[2] = uniform(random, -1, 1);
  p.pair = {};
  p.pair.a = &p.a;
  p.pair.b = &p.b;
  p.pair.axes = matrix(shapes::orientation<Dim>(random));
  p.pair.rotation = matrix(turned(Rotation<Dim>{}, tilt));
  for (int k = 0; k + 1 < Dim; ++k)
    p.pair.offset[k] = flush ? depth * uniform(random, -3, 3) : uniform(random, -0.3, 0.3);
  p.pair.offset[Dim - 1] = 1 - depth;
  p.pair.level = QueryLevel::area;
}

template <int Dim>
Contact<Dim> contact_of(const Posed<Dim>& p) {
  Contact<Dim> c;
  c.status = ContactStatus::touching;
  c.proof.kind = ProofKind::interior_point;
  c.proof.point = Vector<Dim>::Zero();
  c.proof.point[Dim - 1] = 0.5 * p.pair.offset[Dim - 1];
  for (int k = 0; k + 1 < Dim; ++k)
    c.proof.point[k] = 0.5 * p.pair.offset[k];
  return c;
}

template <int Dim>
Pair<Dim> moved(const Pair<Dim>& pair, int freedom, double step) {
  Pair<Dim> then = pair;
  if (freedom < Dim) {
    then.offset += step * pair.axes.row(freedom).transpose();
    return then;
  }
  Spin<Dim> turn = Spin<Dim>::Zero();
  turn[freedom - Dim] = step;
  then.rotation = pair.axes.transpose() * matrix(turned(Rotation<Dim>{}, turn)) * pair.axes * pair.rotation;
  return then;
}

// largest distance from the differences over the scale of each number, a face of unit area
struct Worst {
  double force = 0, moment = 0, centre = 0, area = 0, polar = 0;
};

template <int Dim>
struct Pressed {
  Contact<Dim> contact;
  IntegratedContact<Dim> face;
  Spin<Dim> about;  // m⁴, the planes' origin
};

template <int Dim>
Pressed<Dim> press(const Pair<Dim>& pair, const Contact<Dim>& contact) {
  Pressed<Dim> p{contact, {}, {}};
  HalfSpaces<Dim> planes;
  find_nearest_faces<Dim>(pair, p.contact, planes);
  EXPECT_TRUE((integrate_contact<Dim>(pair, planes, p.contact, p.face)));
  const Vector<Dim> lever = p.contact.geometry.point - pair.axes * contact.proof.point;
  p.about = p.face.couple + moment(lever, p.face.force);
  return p;
}

template <int Dim>
bool compare(Random& random, double depth, bool flush, Worst& worst) {
  Posed<Dim> posed;
  pose<Dim>(random, depth, flush, posed);
  const Contact<Dim> contact = contact_of<Dim>(posed);
  const Pressed<Dim> now = press<Dim>(posed.pair, contact);
  FaceSensitivity<Dim> s;
  if (!find_sensitivity<Dim>(posed.pair, now.contact, s)) return false;
  for (int f = 0; f < freedoms<Dim>; ++f) {
    const double step = 1e-4 * depth;
    const Pressed<Dim> more = press<Dim>(moved<Dim>(posed.pair, f, step), contact),
                       less = press<Dim>(moved<Dim>(posed.pair, f, -step), contact);
    const auto note = [&](const auto& after, const auto& before, const auto& slope, double scale, double& most) {
      most = std::max(most, ((after - before) / (2 * step) - slope).norm() / scale);
    };
    const auto note_number = [&](double after, double before, double slope, double& most) {
      most = std::max(most, depth * std::abs((after - before) / (2 * step) - slope));
    };
    note(more.face.force, less.face.force, s.force.col(f), 1, worst.force);
    note(more.about, less.about, s.moment.col(f), 1, worst.moment);
    // where the overlap ends within the faces, its end moves by as much as one over the tilt, which is about the depth
    note(more.face.centre, less.face.centre, s.centre.col(f), 1 / depth, worst.centre);
    note_number(more.contact.geometry.area, less.contact.geometry.area, s.area[f], worst.area);
    if (Dim == 3) note_number(more.face.polar, less.face.polar, s.polar[f], worst.polar);

    // and the contact that is moved by it has these numbers
    Contact<Dim> then = now.contact;
    IntegratedContact<Dim> face = now.face;
    move_by<Dim>(posed.pair, s, f, step, then, face);
    const Vector<Dim> lever = then.geometry.point - posed.pair.axes * contact.proof.point;
    const Spin<Dim> about = face.couple + moment(lever, face.force);
    EXPECT_LT((about - now.about - step * s.moment.col(f)).norm(), 1e-15);
    EXPECT_LT((face.normal - face.force.normalized()).norm(), 1e-14);
    EXPECT_NEAR(then.geometry.overlap * then.geometry.area, face.force.norm(), 1e-15);
    if constexpr (Dim == 3) {
      EXPECT_LT((face.polygon.axes.transpose() * face.normal).norm(), 1e-12);
      EXPECT_NEAR(face.polygon.overlap, more.face.polygon.overlap, 1e-2 * step);
      EXPECT_LT((face.polygon.gradient - more.face.polygon.gradient).norm(), 0.1 * step);
    }
  }
  return true;
}

// `left_out`: times the square of the depth, and times the depth itself of flush sides, whose crossing moves
template <int Dim>
void expect_agreement(bool flush, double left_out, double of_crossing) {
  for (const double depth : {1e-3, 1e-4, 1e-5}) {
    Random random(7);
    Worst worst;
    int compared = 0;
    for (int i = 0; i < 300; ++i)
      compared += compare<Dim>(random, depth, flush, worst);
    EXPECT_GT(compared, 250);
    const double rounding = 1e-11 / depth, most = left_out * depth * depth + of_crossing * depth + rounding;
    const std::string which = fmt::format("{} dimensions, flush {}, depth {:g}", Dim, flush, depth);
    EXPECT_LT(worst.force, most) << which;
    EXPECT_LT(worst.moment, most) << which;
    EXPECT_LT(worst.centre, 1e-4) << which;
    EXPECT_LT(worst.area, 1e-4) << which;
    EXPECT_LT(worst.polar, 1e-4) << which;
  }
}

TEST(FaceSensitivity, IsThatOfTheIntegratedContact) {
  expect_agreement<2>(false, 5, 0);
  expect_agreement<3>(false, 50, 0);
}
TEST(FaceSensitivity, OfFlushFaces) {
  expect_agreement<2>(true, 5, 0);
  expect_agreement<3>(true, 50, 0.02);
}

}  // namespace
}  // namespace voussoir::face_sensitivity_test
