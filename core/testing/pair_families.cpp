#include "core/testing/pair_families.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/testing/shapes.hpp"

namespace voussoir::families {
namespace {

using shapes::integer;
using shapes::power_of_ten;
using shapes::Random;
using shapes::turned_anyhow;
using shapes::uniform;

constexpr double pi = std::numbers::pi;

// ---- blocks ---------------------------------------------------------------------------------------------------------

// 6, 12, 20 or 50 faces before redundant ones are dropped
template <int Dim>
Polytope<Dim> random_block(Random& random) {
  static constexpr std::array counts{6, 12, 20, 50};
  const int pick = integer(random, 0, 9);  // large ones cost most and test little more: every tenth
  const int count = Dim == 2 ? counts[pick % 3] : counts[pick == 9 ? 3 : pick % 3];
  return shapes::centred_block<Dim>(shapes::random_planes<Dim>(random, count - 2 * Dim, 1));
}

Polytope<3> regular_block(Random& random, Vector<3>*) {
  const HalfSpaces<3> planes = shapes::platonic_solids(1)[integer(random, 0, 4)].planes;
  return shapes::centred_block<3>(integer(random, 0, 1) ? planes : turned_anyhow<3>(planes, random));
}
Polytope<2> regular_block(Random& random, Vector<2>*) {
  const HalfSpaces<2> planes = shapes::regular_polygon(integer(random, 3, 12), 1);
  return shapes::centred_block<2>(integer(random, 0, 1) ? planes : turned_anyhow<2>(planes, random));
}

// three joint sets, each joint a little off its set's mean, cut a block out
template <int Dim>
Polytope<Dim> joint_cut_block(Random& random) {
  HalfSpaces<Dim> planes = shapes::cube<Dim>(3);
  for (int set = 0; set < 3; ++set) {
    const Vector<Dim> mean = shapes::direction<Dim>(random);
    for (int joint = integer(random, 1, 3); joint > 0; --joint)
      for (const double side : {-1.0, 1.0}) {
        const double scatter = power_of_ten(random, -4, -1);
        const Vector<Dim> n = (side * mean + scatter * shapes::direction<Dim>(random)).normalized();
        planes.push_back({n, uniform(random, 0.5, 1.5)});
      }
  }
  return shapes::centred_block<Dim>(planes);
}

// L2: a cube with a second face turned by 10^-k rad about a line inside the face, at its edge or outside it
template <int Dim>
Polytope<Dim> folded_cube(Random& random) {
  HalfSpaces<Dim> planes = shapes::cube<Dim>(1);
  const double angle = std::pow(10.0, -integer(random, 3, 15));
  static constexpr std::array hinges{0.0, 0.5, 1.0, 1.5};
  const double hinge = hinges[integer(random, 0, 3)];
  Vector<Dim> n = Vector<Dim>::Zero(), point = Vector<Dim>::Zero();
  n[Dim - 1] = std::cos(angle);
  n[0] = std::sin(angle);
  point[Dim - 1] = 1;
  point[0] = hinge;
  planes.push_back({n, n.dot(point)});
  return shapes::centred_block<Dim>(planes);
}

// L5: slabs and needles to 1e6, wedges with an angle to 1e-6
Polytope<3> sliver(Random& random, Vector<3>*) {
  const double thin = power_of_ten(random, -6, -1);
  switch (integer(random, 0, 2)) {
    case 0:
      return shapes::centred_block<3>(shapes::box<3>({-1, -1, -thin}, {1, 1, thin}));
    case 1:
      return shapes::centred_block<3>(turned_anyhow<3>(shapes::box<3>({-1, -thin, -thin}, {1, thin, thin}), random));
    default: {
      // a tetrahedron whose faces through the x axis enclose the angle
      const double s = std::sin(thin), c = std::cos(thin);
      return shapes::centred_block<3>({{{0, 0, -1}, 0},
                                       {{0, -s, c}, 0},
                                       {Vector<3>(1, 1, 0).normalized(), std::numbers::sqrt2},
                                       {Vector<3>(-1, 1, 0).normalized(), std::numbers::sqrt2}});
    }
  }
}
Polytope<2> sliver(Random& random, Vector<2>*) {
  const double thin = power_of_ten(random, -6, -1);
  if (integer(random, 0, 1)) return shapes::centred_block<2>(shapes::box<2>({-1, -thin}, {1, thin}));
  return shapes::centred_block<2>({{{0, -1}, 0}, {{-std::sin(thin), std::cos(thin)}, 0}, {{1, 0}, 1}});
}

template <int Dim>
Polytope<Dim> resized(const Polytope<Dim>& part, double factor) {
  return shapes::centred_block<Dim>(shapes::scaled<Dim>(part.faces, factor));
}

// ---- features -------------------------------------------------------------------------------------------------------

// a point of a block and a direction in which no other point of it is farther
template <int Dim>
struct Feature {
  Vector<Dim> point, direction;
};

// the corners that span it, and any positive mean of the normals of the faces that contain them all
template <int Dim>
Feature<Dim> feature_at(const Polytope<Dim>& part, const std::vector<int>& corners, Random& random) {
  Feature<Dim> f{Vector<Dim>::Zero(), Vector<Dim>::Zero()};
  double sum = 0;
  for (const int c : corners) {
    const double weight = uniform(random, 0.05, 1);
    f.point += weight * part.vertices[c];
    sum += weight;
  }
  f.point /= sum;
  for (const int face : shapes::faces_at<Dim>(part, corners))
    f.direction += uniform(random, 0.05, 1) * part.faces[face].normal;
  f.direction.normalize();
  return f;
}

template <int Dim>
Feature<Dim> random_feature(const Polytope<Dim>& part, Random& random) {
  const std::vector<int>& loop = part.loops[integer(random, 0, static_cast<int>(part.faces.size()) - 1)];
  const int corners = static_cast<int>(loop.size()), first = integer(random, 0, corners - 1);
  switch (integer(random, 0, 2)) {
    case 0:
      return feature_at<Dim>(part, loop, random);
    case 1:
      return feature_at<Dim>(part, {loop[first], loop[(first + 1) % corners]}, random);
    default:
      return feature_at<Dim>(part, {loop[first]}, random);
  }
}

// the turn that takes one direction against another, with any spin about it or none
Matrix<3> against(const Vector<3>& from, const Vector<3>& to, Random& random) {
  const Matrix<3> spin =
      Eigen::AngleAxisd(integer(random, 0, 2) ? uniform(random, -pi, pi) : 0.0, to).toRotationMatrix();
  return spin * matrix(rotation_onto(from, -to));
}
Matrix<2> against(const Vector<2>& from, const Vector<2>& to, Random&) {
  return matrix(Rotation<2>{std::atan2(-to[1], -to[0]) - std::atan2(from[1], from[0])});
}

Matrix<3> small_turn(Random& random, double angle, Vector<3>*) {
  return Eigen::AngleAxisd(angle, shapes::direction<3>(random)).toRotationMatrix();
}
Matrix<2> small_turn(Random&, double angle, Vector<2>*) {
  return matrix(Rotation<2>{angle});
}

template <int Dim>
Matrix<Dim> small_turn(Random& random, double angle) {
  return small_turn(random, angle, static_cast<Vector<Dim>*>(nullptr));
}

double random_gap(Random& random, double size) {
  const int k = integer(random, 0, 35);
  if (k == 35) return 0;
  return (k % 2 ? size : -size) * std::pow(10.0, -(k / 2));
}

// ---- poses ----------------------------------------------------------------------------------------------------------

// Features meet at a gap; sometimes tilted by 10^-k rad. The rotation is rounded first, then the gap is set.
template <int Dim>
void meet(Case<Dim>& c, Random& random) {
  const Feature<Dim> on_a = random_feature<Dim>(c.a, random), on_b = random_feature<Dim>(c.b, random);
  c.rotation = against(on_b.direction, on_a.direction, random);
  if (integer(random, 0, 1)) c.rotation = small_turn<Dim>(random, std::pow(10.0, -integer(random, 1, 16))) * c.rotation;
  const double size = std::min(c.a.inscribed_radius, c.b.inscribed_radius);
  c.offset = on_a.point - c.rotation * on_b.point + random_gap(random, size) * on_a.direction;
}

// L4: the bodies are 0 .. 1e6 m from the origin in any orientation; poses as a step makes them, references subtracted
// first
template <int Dim>
void send_away(Case<Dim>& c, Random& random) {
  const Matrix<Dim> axes_a = matrix(shapes::orientation<Dim>(random)), axes_b = axes_a * c.rotation;
  const Vector<Dim> reference_a = power_of_ten(random, 0, 6) * shapes::direction<Dim>(random);
  const Vector<Dim> wanted = axes_a * c.offset;
  const Vector<Dim> reference_b = reference_a + wanted;
  const Vector<Dim> between = reference_b - reference_a, displacement_b = wanted - between;
  c.rotation = axes_a.transpose() * axes_b;
  c.offset = axes_a.transpose() * (between + displacement_b);
}

// L6: boxes of whole edges in whole places, one of them reflected or with its axes exchanged: touching is exact
template <int Dim>
void touch_exactly(Case<Dim>& c, Random& random) {
  Vector<Dim> half_a, half_b;
  for (int k = 0; k < Dim; ++k) {
    half_a[k] = integer(random, 1, 4);
    half_b[k] = integer(random, 1, 4);
  }
  c.a = shapes::centred_block<Dim>(shapes::box<Dim>(-half_a, half_a));
  c.b = shapes::centred_block<Dim>(shapes::box<Dim>(-half_b, half_b));
  c.rotation.setZero();
  std::vector<int> axes;
  for (int k = 0; k < Dim; ++k)
    axes.push_back(k);
  shapes::shuffle(axes, random);
  for (int k = 0; k < Dim; ++k)
    c.rotation(k, axes[k]) = integer(random, 0, 1) ? 1 : -1;
  const Vector<Dim> reach = half_a + (c.rotation * half_b).cwiseAbs();
  // along one axis they touch; along the others faces, edges or corners do, or they pass each other
  const int across = integer(random, 0, Dim - 1);
  for (int k = 0; k < Dim; ++k) {
    const int steps = static_cast<int>(reach[k]);
    c.offset[k] = k == across || integer(random, 0, 3) == 0 ? (integer(random, 0, 1) ? reach[k] : -reach[k])
                                                            : integer(random, -steps, steps);
  }
  // every fourth one grain to one side or the other
  if (integer(random, 0, 3) == 0)
    c.offset[across] = std::nextafter(c.offset[across], integer(random, 0, 1) ? 1e9 : -1e9);
}

// L7: one inside the other, often at the same centre
template <int Dim>
void contain(Case<Dim>& c, Random& random) {
  c.a = random_block<Dim>(random);
  c.b = integer(random, 0, 1) ? c.a : resized<Dim>(random_block<Dim>(random), power_of_ten(random, -3, -0.3));
  c.rotation = integer(random, 0, 1) ? Matrix<Dim>(Matrix<Dim>::Identity()) : matrix(shapes::orientation<Dim>(random));
  c.offset = integer(random, 0, 1) ? Vector<Dim>(Vector<Dim>::Zero())
                                   : Vector<Dim>(uniform(random, 0, 0.3) * shapes::direction<Dim>(random));
}

// L10: a block on its mirror image, face on face: full edges of optimal bases
template <int Dim>
void stack(Case<Dim>& c, Random& random) {
  c.a = integer(random, 0, 1) ? shapes::centred_block<Dim>(shapes::cube<Dim>(0.5))
                              : regular_block(random, static_cast<Vector<Dim>*>(nullptr));
  HalfSpaces<Dim> mirrored = c.a.faces;
  for (HalfSpace<Dim>& f : mirrored)
    f.normal = -f.normal;
  c.b = shapes::centred_block<Dim>(mirrored);
  c.rotation.setIdentity();
  const int face = integer(random, 0, static_cast<int>(c.a.faces.size()) - 1);
  const HalfSpace<Dim>& f = c.a.faces[face];
  c.offset = (2 * f.offset + random_gap(random, c.a.inscribed_radius)) * f.normal;
  if (integer(random, 0, 1)) c.offset += uniform(random, 0, 0.4) * perpendicular(f.normal);
}

// the kinds of family, each as often as it is listed here
enum class Family { random, regular, joint_cut, folded, far, sliver, exact_touch, contained, stacked };
constexpr std::array frequencies{Family::random,      Family::random,    Family::random,  Family::regular,
                                 Family::regular,     Family::regular,   Family::folded,  Family::folded,
                                 Family::joint_cut,   Family::far,       Family::far,     Family::far,
                                 Family::sliver,      Family::sliver,    Family::sliver,  Family::exact_touch,
                                 Family::exact_touch, Family::contained, Family::stacked, Family::stacked};

template <int Dim>
Polytope<Dim> block_of(Family family, Random& random) {
  Vector<Dim>* const dimension = nullptr;
  switch (family) {
    case Family::regular:
      return regular_block(random, dimension);
    case Family::joint_cut:
      return joint_cut_block<Dim>(random);
    case Family::folded:
      return folded_cube<Dim>(random);
    case Family::sliver:
      return sliver(random, dimension);
    default:
      return random_block<Dim>(random);
  }
}

template <int Dim>
void make_pair_of(Case<Dim>& c, Family family, Random& random) {
  c.a = block_of<Dim>(family == Family::far ? Family::joint_cut : family, random);
  c.b = block_of<Dim>(integer(random, 0, 2) ? family : Family::random, random);
  // of 1 mm, 1 m or 10 km, and sometimes of unequal size
  static constexpr std::array scales{1e-3, 1.0, 1.0, 1e4};
  const double scale = scales[integer(random, 0, 3)], ratio = integer(random, 0, 2) ? 1 : power_of_ten(random, -2, 2);
  if (scale != 1) c.a = resized<Dim>(c.a, scale);
  if (scale != 1 || ratio != 1) c.b = resized<Dim>(c.b, scale * ratio);
  meet<Dim>(c, random);
  if (family == Family::far) send_away<Dim>(c, random);
}

// a step: 1e-6 .. 1e-3 of the size, often the slower the finer
template <int Dim>
void move(Case<Dim>& c, Random& random) {
  const double fraction = power_of_ten(random, -6, -3), size = std::min(c.a.inscribed_radius, c.b.inscribed_radius);
  c.rotation_after = small_turn<Dim>(random, fraction * uniform(random, 0, 1)) * c.rotation;
  c.offset_after = c.offset + fraction * size * shapes::direction<Dim>(random);
}

constexpr std::array family_names{"L1 random", "L1 regular", "L1 joint-cut", "L2 folded",       "L4 far",
                                  "L5 sliver", "L6 exact",   "L7 contained", "L10 face on face"};

template <int Dim>
std::string literal(const Vector<Dim>& v) {
  std::string text = "{";
  for (int k = 0; k < Dim; ++k)
    text += fmt::format("{}{:a}", k ? ", " : "", v[k]);
  return text + "}";
}

template <int Dim>
std::string literal(const Polytope<Dim>& part) {
  std::string text = "{";
  for (const HalfSpace<Dim>& f : part.faces)
    text += fmt::format("{{{}, {:a}}},\n ", literal<Dim>(f.normal), f.offset);
  return text + "}";
}

template <int Dim>
std::string literal(const Matrix<Dim>& m) {
  std::string text;
  for (int i = 0; i < Dim; ++i)
    for (int k = 0; k < Dim; ++k)
      text += fmt::format("{}{:a}", i + k ? ", " : "", m(i, k));
  return text;
}

}  // namespace

template <int Dim>
Case<Dim> numbered_case(std::uint64_t seed, long long number) {
  Random random(seed + 0x9e3779b97f4a7c15u * static_cast<std::uint64_t>(number + 1));
  const Family family = frequencies[number % frequencies.size()];
  Case<Dim> c;
  c.family = family_names[static_cast<int>(family)];
  switch (family) {
    case Family::exact_touch:
      touch_exactly<Dim>(c, random);
      break;
    case Family::contained:
      contain<Dim>(c, random);
      break;
    case Family::stacked:
      stack<Dim>(c, random);
      break;
    default:
      make_pair_of<Dim>(c, family, random);
  }
  move<Dim>(c, random);
  return c;
}

template <int Dim>
std::string literals(const Case<Dim>& c) {
  return fmt::format("a: {}\nb: {}\nrotation {}\noffset {}\nafter the move: rotation {}\noffset {}\n",
                     literal<Dim>(c.a), literal<Dim>(c.b), literal<Dim>(c.rotation), literal<Dim>(c.offset),
                     literal<Dim>(c.rotation_after), literal<Dim>(c.offset_after));
}

template Case<2> numbered_case<2>(std::uint64_t, long long);
template Case<3> numbered_case<3>(std::uint64_t, long long);
template std::string literals<2>(const Case<2>&);
template std::string literals<3>(const Case<3>&);

}  // namespace voussoir::families
