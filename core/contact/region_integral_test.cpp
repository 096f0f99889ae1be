// The overlap as a spring: its energy against volumes, force and moment as its derivatives, the swap of both parts,
// scales; and the integrated contact, flat, at its edges and corners, and between.
#include "core/contact/region_integral.hpp"

#include <gtest/gtest.h>

#include "core/contact/face_integral.hpp"
#include "core/contact/integrated_contact.hpp"
#include "core/testing/contacts.hpp"
#include "core/testing/exact_referee.hpp"

namespace voussoir::region_integral_test {
namespace {

using namespace contacts;
using shapes::Random, shapes::uniform, shapes::integer, shapes::power_of_ten;

// of the region's extent for its corners; of energy and force themselves, times the extent over the thickness
constexpr double promised = 1e-11;

// the thickness: twice the energy over the force is some half of it
template <int Dim>
double allowed(const RegionIntegral<Dim>& region) {
  return promised * (1 + std::sqrt(region.spread) * region.force.norm() / region.square);
}

// central differences of an energy with an error of 1e-13, over steps of 1e-4 of the depth: their second order
constexpr double of_differences = 1e-6;

template <int Dim>
Polytope<Dim> random_part(Random& random) {
  if constexpr (Dim == 3) {
    const auto solids = shapes::platonic_solids(uniform(random, 0.5, 1));
    if (integer(random, 0, 1) == 0) return shapes::block<3>(solids[integer(random, 0, 4)].planes);
    return shapes::block<3>(shapes::random_planes<3>(random, integer(random, 0, 8), 1));
  } else {
    return shapes::block<2>(shapes::random_planes<2>(random, integer(random, 0, 5), 1));
  }
}

// two parts that overlap by about `depth`
template <int Dim>
struct Overlapping {
  Polytope<Dim> a, b;
  Pair<Dim> pair;
  Contact<Dim> contact;
};

template <int Dim>
void put_together(Random& random, double depth, Overlapping<Dim>& o) {
  o.a = random_part<Dim>(random);
  o.b = random_part<Dim>(random);
  const Matrix<Dim> turn = matrix(shapes::orientation<Dim>(random));
  const Vector<Dim> along = shapes::direction<Dim>(random);
  const double away = distance_of_touching<Dim>(o.a, o.b, turn, along);
  o.pair = {&o.a, &o.b, Matrix<Dim>::Identity(), turn, (away - depth) * along};
  const auto found = touch<Dim>(o.a, o.b, turn, o.pair.offset);
  o.contact = found.contact;
  ASSERT_TRUE(o.contact.touching());
}

template <int Dim>
double reach_of(const Pair<Dim>& pair) {
  return 4 * std::min(pair.a->radius, pair.b->radius);
}

template <int Dim>
RegionIntegral<Dim> region_of(const HalfSpaces<Dim>& planes, int faces_a, double reach) {
  RegionIntegral<Dim> region;
  EXPECT_EQ(integrate_region<Dim>(planes, faces_a, reach, region), RegionStatus::ok);
  return region;
}

// ---- energy ------------------------------------------------------------------------------------------------------

TEST(RegionIntegral, OfASlabIsTheClosedForm) {
  for (const double thin : {1.0, 1e-2, 1e-5, 1e-9}) {
    // on both sides of the overlap a face of either part; the sides are the first one's
    const HalfSpaces<3> planes{{{0, 0, 1}, 0.3 * thin}, {{1, 0, 0}, 1},    {{-1, 0, 0}, 1},
                               {{0, 1, 0}, 1.5},        {{0, -1, 0}, 1.5}, {{0, 0, -1}, 0.7 * thin}};
    const RegionIntegral<3> region = region_of<3>(planes, 5, 8);
    const double u = thin;  // ∫ (2 - 2t)(3 - 2t)(u - 2t) dt to u/2
    const double phi = 6 * u * u / 4 - 10 * u * u * u / 24 + 4 * u * u * u * u / 96;
    EXPECT_NEAR(region.square, 4 * phi, allowed(region) * 4 * phi);
    // the force of the second part's one face: half of the energy's slope in its overlap
    const double slope = 6 * u / 2 - 10 * u * u / 8 + 4 * u * u * u / 24;
    EXPECT_NEAR(region.force[2], 2 * slope, allowed(region) * 2 * slope);
    EXPECT_NEAR(region.force.head<2>().norm(), 0, allowed(region) * slope);
    EXPECT_NEAR(region.pressure.head<2>().norm(), 0, allowed(region));
  }
}

// ---- the same in rational numbers ---------------------------------------------------------------------------------

using exact::Rational;

template <int Size>
using RationalMatrix = std::array<std::array<Rational, Size + 1>, Size>;

// rows of `m` to the unit matrix; the determinant, 0 if there is none
template <int Size>
Rational eliminate(RationalMatrix<Size>& m) {
  Rational determinant = 1;
  for (int c = 0; c < Size; ++c) {
    int p = c;
    while (p < Size && m[p][c] == 0)
      ++p;
    if (p == Size) return 0;
    if (p != c) {
      std::swap(m[c], m[p]);
      determinant = -determinant;
    }
    determinant *= m[c][c];
    for (int k = Size; k >= c; --k)
      m[c][k] /= m[c][c];
    for (int r = 0; r < Size; ++r)
      if (r != c && m[r][c] != 0)
        for (int k = Size; k >= c; --k)
          m[r][k] -= m[r][c] * m[c][k];
  }
  return determinant;
}

// {(x, t): a·x + t <= d, t >= 0}: every corner from its planes, its volume by cones from corners
template <int Dim>
struct RationalPolytope {
  static constexpr int size = Dim + 1;
  struct Corner {
    std::vector<int> on;
    std::array<Rational, size> y;
  };
  std::vector<std::array<double, size + 1>> rows;
  std::vector<Corner> corners;

  explicit RationalPolytope(const HalfSpaces<Dim>& planes) {
    for (const HalfSpace<Dim>& p : planes) {
      auto& row = rows.emplace_back();
      std::ranges::copy(p.normal, row.begin());
      row[Dim] = 1;
      row[size] = p.offset;
    }
    rows.emplace_back()[Dim] = -1;
    oracle::for_each_choice(static_cast<int>(rows.size()), size, [&](const std::vector<int>& choice) { add(choice); });
  }

  void add(const std::vector<int>& choice) {
    // most are far outside, as doubles show
    Eigen::Matrix<double, size, size> a;
    Eigen::Matrix<double, size, 1> b;
    for (int k = 0; k < size; ++k) {
      for (int c = 0; c < size; ++c)
        a(k, c) = rows[choice[k]][c];
      b[k] = rows[choice[k]][size];
    }
    const Eigen::FullPivLU<Eigen::Matrix<double, size, size>> lu(a);
    if (!lu.isInvertible()) return;
    const Eigen::Matrix<double, size, 1> near = lu.solve(b);
    for (const auto& row : rows) {
      double slack = row[size];
      for (int c = 0; c < size; ++c)
        slack -= row[c] * near[c];
      if (slack < -1e-6 * (1 + near.norm())) return;
    }
    RationalMatrix<size> m;
    for (int k = 0; k < size; ++k)
      for (int c = 0; c <= size; ++c)
        m[k][c] = rows[choice[k]][c];
    if (eliminate<size>(m) == 0) return;
    Corner corner{choice, {}};
    for (int k = 0; k < size; ++k)
      corner.y[k] = m[k][size];
    for (const auto& row : rows) {
      Rational slack = row[size];
      for (int c = 0; c < size; ++c)
        slack -= Rational(row[c]) * corner.y[c];
      if (slack < 0) return;
    }
    corners.push_back(corner);
  }

  // of the cone from the corners so far over the face on the planes `fixed`
  Rational cones(const std::vector<const Corner*>& among, std::vector<const Corner*>& apexes) const {
    if (among.empty()) return 0;
    if (static_cast<int>(apexes.size()) == size) {
      RationalMatrix<size> m;
      for (int k = 0; k < size; ++k)
        for (int c = 0; c < size; ++c)
          m[k][c] = apexes[k]->y[c] - among[0]->y[c];
      return abs(eliminate<size>(m));
    }
    Rational sum = 0;
    apexes.push_back(among[0]);
    for (int plane = 0; plane < static_cast<int>(rows.size()); ++plane) {
      const auto is_on = [&](const Corner* c) { return std::ranges::find(c->on, plane) != c->on.end(); };
      if (std::ranges::all_of(among, is_on) || is_on(among[0])) continue;
      std::vector<const Corner*> facet;
      std::ranges::copy_if(among, std::back_inserter(facet), is_on);
      if (static_cast<int>(facet.size()) + static_cast<int>(apexes.size()) > size) sum += cones(facet, apexes);
    }
    apexes.pop_back();
    return sum;
  }

  double volume() const {
    std::vector<const Corner*> all, apexes;
    for (const Corner& c : corners)
      all.push_back(&c);
    return cones(all, apexes).get_d() / (size == 4 ? 24 : 6);
  }
};

template <int Dim>
double energy_of(const HalfSpaces<Dim>& planes) {
  return 4 * RationalPolytope<Dim>(planes).volume();
}

template <int Dim>
HalfSpaces<Dim> seen_planes(const Overlapping<Dim>& o) {
  HalfSpaces<Dim> planes;
  assemble<Dim>(o.pair, o.contact.proof.point, planes);
  return planes;
}

template <int Dim>
void expect_energy() {
  Random random(7);
  for (int i = 0; i < 40; ++i) {
    Overlapping<Dim> o;
    put_together(random, power_of_ten(random, -9, -0.5), o);
    const HalfSpaces<Dim> planes = seen_planes(o);
    const RegionIntegral<Dim> region = region_of<Dim>(planes, static_cast<int>(o.a.faces.size()), reach_of(o.pair));
    const double should = energy_of<Dim>(planes);
    EXPECT_NEAR(region.square, should, allowed(region) * should) << i;
  }
}

TEST(RegionIntegral, EnergyIsTheVolumeOfTheLiftedPolytope) {
  expect_energy<2>();
  expect_energy<3>();
}

// ---- force and moment --------------------------------------------------------------------------------------------

// the pair as its second part moves by `step` along a degree of freedom; turns about the first one's centroid
template <int Dim>
Pair<Dim> moved(Pair<Dim> pair, int freedom, double step) {
  if (freedom < Dim) {
    pair.offset[freedom] += step;
    return pair;
  }
  Spin<Dim> turn = Spin<Dim>::Zero();
  turn[freedom - Dim] = step;
  const Matrix<Dim> by = matrix(turned(Rotation<Dim>{}, turn));
  pair.offset = by * pair.offset;
  pair.rotation = by * pair.rotation;
  return pair;
}

// Of an energy and its force and moment about the first centroid, as functions of the pair: all degrees of freedom by
// central differences, against the force's size.
template <int Dim, class Energy>
double worst_difference(const Pair<Dim>& pair, double step, double force,
                        const Eigen::Matrix<double, freedoms<Dim>, 1>& w, const Energy& square) {
  double worst = 0;
  for (int f = 0; f < freedoms<Dim>; ++f) {
    const double slope = -(square(moved(pair, f, step)) - square(moved(pair, f, -step))) / (4 * step);
    worst = std::max(worst, std::abs(slope - w[f]) / force);
  }
  return worst;
}

template <int Dim>
void expect_derivatives() {
  Random random(11);
  for (int i = 0; i < 60; ++i) {
    Overlapping<Dim> o;
    const double depth = power_of_ten(random, -4, -0.5);
    put_together(random, depth, o);
    const int faces_a = static_cast<int>(o.a.faces.size());
    const RegionIntegral<Dim> region = region_of<Dim>(seen_planes(o), faces_a, reach_of(o.pair));
    Eigen::Matrix<double, freedoms<Dim>, 1> w;
    w << region.force, region.moment + moment(o.contact.proof.point, region.force);
    const double worst =
        worst_difference<Dim>(o.pair, 1e-4 * depth, region.force.norm(), w, [&](const Pair<Dim>& pair) {
          HalfSpaces<Dim> planes;
          assemble<Dim>(pair, o.contact.proof.point, planes);
          return region_of<Dim>(planes, faces_a, reach_of(pair)).square;
        });
    EXPECT_LT(worst, of_differences) << i << ", depth " << depth;
  }
}

TEST(RegionIntegral, ForceAndMomentAreTheEnergysDerivative) {
  expect_derivatives<2>();
  expect_derivatives<3>();
}

// whose corners follow their planes, against regions that are cut again
template <int Dim>
void expect_regions_followed() {
  Random random(12);
  int followed = 0;
  for (int i = 0; i < 60; ++i) {
    Overlapping<Dim> o;
    const double depth = power_of_ten(random, -4, -0.5);
    put_together(random, depth, o);
    const int faces_a = static_cast<int>(o.a.faces.size());
    std::vector<HalfSpaces<Dim>> planes(freedoms<Dim>);
    std::vector<RegionIntegral<Dim>> regions(freedoms<Dim>);
    for (int f = 0; f < freedoms<Dim>; ++f)
      assemble<Dim>(moved(o.pair, f, 1e-6 * depth), o.contact.proof.point, planes[f]);
    if (!integrate_moved_regions<Dim>(seen_planes(o), faces_a, reach_of(o.pair), i % 2 == 0, planes, regions)) continue;
    ++followed;
    for (int f = 0; f < freedoms<Dim>; ++f) {
      const RegionIntegral<Dim> cut = region_of<Dim>(planes[f], faces_a, reach_of(o.pair));
      const double scale = allowed(cut);
      if (i % 2 == 0) EXPECT_NEAR(regions[f].square, cut.square, scale * cut.square) << i;
      EXPECT_LT((regions[f].force - cut.force).norm(), scale * cut.force.norm()) << i;
      EXPECT_LT((regions[f].moment - cut.moment).norm(), scale * cut.force.norm()) << i;
      EXPECT_LT((regions[f].pressure - cut.pressure).norm(), scale) << i;
    }
  }
  EXPECT_GT(followed, 50);
}

TEST(RegionIntegral, CornersFollowTheirPlanesInSmallMotions) {
  expect_regions_followed<2>();
  expect_regions_followed<3>();
}

TEST(RegionIntegral, ACornerOnMorePlanesThanDetermineItIsNotFollowed) {
  std::vector<HalfSpaces<3>> pyramid(1);
  for (const Vector<3>& n : {Vector<3>(1, 0, 1), Vector<3>(-1, 0, 1), Vector<3>(0, 1, 1), Vector<3>(0, -1, 1)})
    pyramid[0].push_back({n.normalized(), 1});
  pyramid[0].push_back({{0, 0, -1}, 0});
  std::vector<RegionIntegral<3>> regions(1);
  EXPECT_FALSE(integrate_moved_regions<3>(pyramid[0], 4, 8, true, pyramid, regions));
}

template <int Dim>
void expect_swap_and_scale() {
  Random random(13);
  for (int i = 0; i < 40; ++i) {
    Overlapping<Dim> o;
    put_together(random, power_of_ten(random, -8, -0.5), o);
    HalfSpaces<Dim> planes = seen_planes(o);
    const int faces_a = static_cast<int>(o.a.faces.size());
    const double reach = reach_of(o.pair);
    const RegionIntegral<Dim> region = region_of<Dim>(planes, faces_a, reach);
    const double extent = std::sqrt(region.spread) + region.pressure.norm();

    HalfSpaces<Dim> swapped(planes.begin() + faces_a, planes.end());
    swapped.insert(swapped.end(), planes.begin(), planes.begin() + faces_a);
    const RegionIntegral<Dim> other = region_of<Dim>(swapped, static_cast<int>(planes.size()) - faces_a, reach);
    const double room = allowed(region);
    EXPECT_NEAR(other.square, region.square, room * region.square);
    EXPECT_LT((other.force + region.force).norm(), room * region.force.norm());
    EXPECT_LT((other.moment + region.moment).norm(), room * region.force.norm() * extent);
    EXPECT_LT((other.pressure - region.pressure).norm(), room * extent);
    EXPECT_NEAR(other.area, region.area, room * region.area);

    for (const double scale : {0x1p-10, 0x1p13}) {  // some 1 mm and 10 km; no offset is rounded again
      HalfSpaces<Dim> scaled = planes;
      for (HalfSpace<Dim>& p : scaled)
        p.offset *= scale;
      const RegionIntegral<Dim> r = region_of<Dim>(scaled, faces_a, scale * reach);
      EXPECT_NEAR(r.square, region.square * std::pow(scale, Dim + 1), room * r.square);
      EXPECT_LT((r.force - std::pow(scale, Dim) * region.force).norm(), room * r.force.norm());
    }
  }
}

TEST(RegionIntegral, IsTheSameFromTheOtherPartAndAtOtherScales) {
  expect_swap_and_scale<2>();
  expect_swap_and_scale<3>();
}

TEST(RegionIntegral, ReportsAnEmptyRegion) {
  HalfSpaces<3> planes = shapes::box<3>({0, 0, 0}, {1, 1, 1});
  for (const HalfSpace<3>& p : shapes::box<3>({0, 0, 1}, {1, 1, 2}))
    planes.push_back(p);
  RegionIntegral<3> region;
  EXPECT_EQ(integrate_region<3>(planes, 6, 8, region), RegionStatus::empty);  // they touch without overlap
  Random random(3);
  HalfSpaces<3> many = shapes::random_planes<3>(random, 2000, 1);  // hundreds of faces
  const int faces_a = static_cast<int>(many.size());
  for (const HalfSpace<3>& p : shapes::cube<3>(0.99))
    many.push_back(p);
  EXPECT_EQ(integrate_region<3>(many, faces_a, 8, region), RegionStatus::too_many_planes);
}

// ---- the integrated contact --------------------------------------------------------------------------------------

// a block on another, its face turned out of the other's by `angle` about a random axis
template <int Dim>
void lay_on(Random& random, double angle, double depth, Overlapping<Dim>& o) {
  o.a = shapes::block<Dim>(shapes::cube<Dim>(1));
  o.b = shapes::block<Dim>(shapes::cube<Dim>(uniform(random, 0.4, 0.9)));
  const int place = integer(random, 0, 4);  // over the other's edge or not, or flush with it
  if (place == 4) angle *= 1e-2;
  Spin<Dim> turn = Spin<Dim>::Zero();
  Rotation<Dim> rotation;
  if constexpr (Dim == 3) {
    const double about = uniform(random, 0, 2 * std::numbers::pi);
    turn = {angle * std::cos(about), angle * std::sin(about), 0};
    if (place < 4) rotation = turned(rotation, {0, 0, uniform(random, 0, 1)});
  } else {
    turn[0] = angle;
  }
  const Matrix<Dim> axes = matrix(turned(rotation, turn));
  Vector<Dim> up = Vector<Dim>::Unit(Dim - 1);
  if (place < 2) up[0] = uniform(random, -0.6, 0.6);
  const double away = distance_of_touching<Dim>(o.a, o.b, axes, up);
  o.pair = {&o.a, &o.b, Matrix<Dim>::Identity(), axes, away * up - depth * Vector<Dim>::Unit(Dim - 1)};
  if (place == 4) o.pair.offset[0] += 1 - o.b.faces[0].offset;
  o.contact = touch<Dim>(o.a, o.b, axes, o.pair.offset).contact;
  ASSERT_TRUE(o.contact.touching());
}

// from flat on its face over every share of both energies to its edge or corner
template <int Dim>
void expect_one_energy() {
  Random random(17);
  int flat = 0, flush = 0, blended = 0, region = 0;
  for (int i = 0; i < 500; ++i) {
    Overlapping<Dim> o;
    const double depth = power_of_ten(random, -4, -1.5);
    lay_on(random, power_of_ten(random, -3, -0.2), depth, o);
    IntegratedContact<Dim> face;
    Contact<Dim>& contact = o.contact;
    HalfSpaces<Dim> planes;
    find_nearest_faces<Dim>(o.pair, contact, planes);
    integrate_contact<Dim>(o.pair, planes, contact, face);
    ASSERT_GT(face.square, 0);
    // the share of both
    RegionIntegral<Dim> r = region_of<Dim>(seen_planes(o), static_cast<int>(o.a.faces.size()), reach_of(o.pair));
    FaceIntegral<Dim> f;
    PressedPolygon polygon;
    const bool faces = integrate_face<Dim>(
        seen_planes(o), static_cast<int>(o.a.faces.size()), o.contact.geometry.face_a,
        static_cast<int>(o.a.faces.size()) + o.contact.geometry.face_b, reach_of(o.pair), f, polygon);
    const double ratio = faces ? r.square / f.square : 0;
    if (std::abs(ratio - 1) <= 0.07) {
      ++(f.flush ? flush : flat);
      EXPECT_EQ(face.square, f.square);
    } else if (std::abs(ratio - 1) >= 0.2) {
      ++region;
      EXPECT_EQ(face.square, r.square);
      EXPECT_FALSE(face.flat);
    } else {
      ++blended;
      EXPECT_TRUE(face.flat);
    }
    Eigen::Matrix<double, freedoms<Dim>, 1> w;
    w << face.force, moment(contact.geometry.point, face.force) + face.couple;
    const double worst = worst_difference<Dim>(o.pair, 1e-4 * depth, face.force.norm(), w, [&](const Pair<Dim>& pair) {
      IntegratedContact<Dim> then;
      Contact<Dim> c = o.contact;
      find_nearest_faces<Dim>(pair, c, planes);
      integrate_contact<Dim>(pair, planes, c, then);
      return then.square;
    });
    // for flush edges E's derivative is shared (face_integral.hpp): at most the deepest overlap over the width
    EXPECT_LT(worst, face.flat && f.flush ? 0.05 : of_differences) << i << ", ratio " << ratio;
  }
  EXPECT_GT(flat, 20);
  EXPECT_GT(flush, 20);
  EXPECT_GT(blended, 20);
  EXPECT_GT(region, 20);
}

TEST(IntegratedContact, IsOneEnergyFromFaceToCorner) {
  expect_one_energy<2>();
  expect_one_energy<3>();
}

}  // namespace
}  // namespace voussoir::region_integral_test
