#include "benchmarks/judge/exact_pairs.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "core/testing/exact_referee.hpp"

namespace voussoir::benchmarks {
namespace {

using exact::Rational;

// planes of one block share a corner if they pass it within this, m, for blocks of about 1; too large costs time only
constexpr double same_corner = 1e-9;
// Translations found in double to be larger than the smallest by more are larger: rounding is 1e-15.
constexpr double surely_larger = 1e-10;
// directions nearer to each other are one
constexpr double same_direction = 1e-9;

exact::Point minus(const exact::Point& a, const exact::Point& b) {
  return {Rational(a[0] - b[0]), Rational(a[1] - b[1]), Rational(a[2] - b[2])};
}

exact::Point cross(const exact::Point& a, const exact::Point& b) {
  return {Rational(a[1] * b[2] - a[2] * b[1]), Rational(a[2] * b[0] - a[0] * b[2]),
          Rational(a[0] * b[1] - a[1] * b[0])};
}

Vector<3> rounded(const exact::Point& p) {
  return {p[0].get_d(), p[1].get_d(), p[2].get_d()};
}

// a block's exact corners, their doubles, and its edges' directions
struct Body {
  exact::Planes planes;
  std::vector<exact::Point> corners;
  std::vector<Vector<3>> near;
  std::vector<exact::Point> edges;  // and some that are none, which do no harm: any direction separates

  explicit Body(const HalfSpaces<3>& half_spaces) : planes(exact::planes_of(half_spaces)) {
    corners = exact::vertices(planes);
    for (const exact::Point& c : corners)
      near.push_back(rounded(c));
    const int count = static_cast<int>(planes.size());
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < i; ++j)
        if (share_a_corner(half_spaces[i], half_spaces[j])) edges.push_back(cross(planes[i].normal, planes[j].normal));
  }

  double reach(const Vector<3>& n) const {
    double most = -std::numeric_limits<double>::max();
    for (const Vector<3>& c : near)
      most = std::max(most, c.dot(n));
    return most;
  }
  Rational exact_reach(const exact::Point& n) const {
    Rational most = exact::dot(corners[0], n);
    for (const exact::Point& c : corners)
      most = std::max(most, exact::dot(c, n));
    return most;
  }

 private:
  bool share_a_corner(const HalfSpace<3>& p, const HalfSpace<3>& q) const {
    return std::any_of(near.begin(), near.end(), [&](const Vector<3>& c) {
      return std::max(std::abs(signed_distance(p, c)), std::abs(signed_distance(q, c))) < same_corner;
    });
  }
};

// B must move by length/|normal| along the normal, which need not be unit
struct Translation {
  exact::Point normal;
  double estimate = 0;  // m
  Rational length, square_of_normal;

  bool shorter_than(const Translation& other) const {
    return length * length * other.square_of_normal < other.length * other.length * square_of_normal;
  }
};

// A translation separates when the difference of the blocks no longer holds the origin: along the normal of one of its
// facets, which are faces of A, reversed faces of B, and products of their edges.
std::vector<Translation> candidates(const Body& a, const Body& b) {
  std::vector<Translation> list;
  double least = std::numeric_limits<double>::max();
  const auto add = [&](const exact::Point& n) {
    const Vector<3> near = rounded(n);
    const double length = near.norm();
    if (length < same_direction) return;
    const double estimate = (a.reach(near) + b.reach(-near)) / length;
    if (estimate > least + surely_larger) return;
    least = std::min(least, estimate);
    list.push_back({n, estimate, {}, {}});
  };
  const exact::Point zero{0, 0, 0};
  for (const exact::Plane& p : a.planes)
    add(p.normal);
  for (const exact::Plane& p : b.planes)
    add(minus(zero, p.normal));
  for (const exact::Point& e : a.edges)
    for (const exact::Point& f : b.edges) {
      add(cross(e, f));
      add(cross(f, e));
    }
  std::erase_if(list, [&](const Translation& t) { return t.estimate > least + surely_larger; });
  for (Translation& t : list) {
    t.length = a.exact_reach(t.normal) + b.exact_reach(minus(zero, t.normal));
    t.square_of_normal = exact::dot(t.normal, t.normal);
  }
  return list;
}

void find_smallest_translation(const Body& a, const Body& b, ExactPair& pair) {
  const std::vector<Translation> list = candidates(a, b);
  const Translation& least = *std::min_element(
      list.begin(), list.end(), [](const Translation& p, const Translation& q) { return p.shorter_than(q); });
  pair.smallest_translation =
      exact::to_double(exact::to_quad(least.length) / exact::root(exact::to_quad(least.square_of_normal)));
  for (const Translation& t : list) {
    if (least.shorter_than(t)) continue;
    const Vector<3> n = rounded(t.normal).normalized();
    const auto same = [&](const Vector<3>& known) { return (known - n).norm() < same_direction; };
    if (std::none_of(pair.normals.begin(), pair.normals.end(), same)) pair.normals.push_back(n);
  }
}

// planes on which at least three of the overlap's corners are
void find_bounding_faces(const exact::Planes& both, std::size_t faces_a, ExactPair& pair) {
  const std::vector<exact::Point> corners = exact::vertices(both);
  for (std::size_t i = 0; i < both.size(); ++i) {
    const auto on_it = std::count_if(corners.begin(), corners.end(), [&](const exact::Point& c) {
      return exact::dot(both[i].normal, c) == both[i].offset;
    });
    if (on_it < 3) continue;
    if (i < faces_a)
      pair.faces_a.push_back(static_cast<int>(i));
    else
      pair.faces_b.push_back(static_cast<int>(i - faces_a));
  }
}

}  // namespace

ExactPair exact_answer(const HalfSpaces<3>& a, const HalfSpaces<3>& b) {
  ExactPair pair;
  pair.a = a;
  pair.b = b;
  HalfSpaces<3> all = a;
  all.insert(all.end(), b.begin(), b.end());
  const exact::Planes both = exact::planes_of(all);
  const exact::Program program = exact::feasibility(both);
  if (!program.bounded) throw std::logic_error("the planes close no block");
  pair.lp_optimum = program.value.get_d();
  pair.touch = sgn(program.value) < 0;
  if (!pair.touch) return pair;

  find_smallest_translation(Body(a), Body(b), pair);
  find_bounding_faces(both, a.size(), pair);
  const exact::Solid overlap = exact::solid(both);
  pair.volume = exact::to_double(overlap.volume);
  for (int k = 0; k < 3; ++k)
    pair.centroid[k] = exact::to_double(overlap.centroid[k]);
  pair.area = exact::to_double(exact::section_area(both, pair.centroid, pair.normals.at(0)));
  return pair;
}

std::vector<ExactPair> exact_pairs(Shape shape, PairState state, std::uint64_t seed, int count) {
  std::vector<ExactPair> list;
  const Workload work = seeded_workload(shape, state, seed, static_cast<std::size_t>(count));
  for (const Pair<3>& p : work.pairs) {
    // rounded to the doubles of the file, of which all that follows is the answer
    ExactPair pair = exact_answer(p.a->faces, shapes::placed<3>(p.b->faces, p.rotation, p.offset));
    pair.shape = name_of(shape);
    pair.state = name_of(state);
    pair.number = static_cast<int>(list.size());
    pair.unit = unit_of(shape);
    list.push_back(std::move(pair));
  }
  return list;
}

PairFile all_exact_pairs(std::uint64_t seed, int count) {
  PairFile file{seed, {}};
  for (int s = 0; s < shape_count; ++s)
    for (int p = 0; p < pair_state_count; ++p) {
      const auto shape = static_cast<Shape>(s);
      const auto state = static_cast<PairState>(p);
      if (state == PairState::solid || !occurs(shape, state)) continue;
      for (ExactPair& pair : exact_pairs(shape, state, seed, count))
        file.pairs.push_back(std::move(pair));
    }
  return file;
}

}  // namespace voussoir::benchmarks
