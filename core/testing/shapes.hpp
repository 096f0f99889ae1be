// Seeded shapes for the tests: the same numbers on every platform.
#pragma once

#include <algorithm>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_int_distribution.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "core/slicing/block.hpp"

namespace voussoir::shapes {

using Random = boost::random::mt19937_64;

inline double uniform(Random& random, double low, double high) {
  return boost::random::uniform_real_distribution<double>(low, high)(random);
}

inline int integer(Random& random, int low, int high) {
  return boost::random::uniform_int_distribution<int>(low, high)(random);
}

// one of a decade 10^low … 10^high
inline double power_of_ten(Random& random, double low, double high) {
  return std::pow(10, uniform(random, low, high));
}

template <int Size>
Eigen::Matrix<double, Size, 1> normal_vector(Random& random) {
  boost::random::normal_distribution<double> normal;
  Eigen::Matrix<double, Size, 1> v;
  for (int k = 0; k < Size; ++k)
    v[k] = normal(random);
  return v;
}

template <int Dim>
Vector<Dim> direction(Random& random) {
  return normal_vector<Dim>(random).normalized();
}

template <int Dim>
Rotation<Dim> orientation(Random& random) {
  if constexpr (Dim == 3) {
    const Eigen::Vector4d q = normal_vector<4>(random).normalized();
    return {Eigen::Quaterniond(q[0], q[1], q[2], q[3])};
  } else {
    return {uniform(random, -std::numbers::pi, std::numbers::pi)};
  }
}

// std::shuffle is not portable
template <class T>
void shuffle(std::vector<T>& list, Random& random) {
  for (int i = static_cast<int>(list.size()) - 1; i > 0; --i)
    std::swap(list[i], list[integer(random, 0, i)]);
}

// ---- half-spaces ----------------------------------------------------------------------------------------------------

template <int Dim>
HalfSpaces<Dim> box(const Vector<Dim>& low, const Vector<Dim>& high) {
  HalfSpaces<Dim> planes;
  for (int k = 0; k < Dim; ++k) {
    planes.push_back({Vector<Dim>::Unit(k), high[k]});
    planes.push_back({-Vector<Dim>::Unit(k), -low[k]});
  }
  return planes;
}

// edges 2 h around the origin
template <int Dim>
HalfSpaces<Dim> cube(double h) {
  return box<Dim>(Vector<Dim>::Constant(-h), Vector<Dim>::Constant(h));
}

// planes in random directions at a distance of 0.6 to 1 radius; a box of 1.2 radius closes them
template <int Dim>
HalfSpaces<Dim> random_planes(Random& random, int count, double radius) {
  HalfSpaces<Dim> planes = cube<Dim>(1.2 * radius);
  for (int i = 0; i < count; ++i)
    planes.push_back({direction<Dim>(random), uniform(random, 0.6, 1.0) * radius});
  return planes;
}

// all sign changes and cyclic permutations of a normal, without repetition
inline void add_family(HalfSpaces<3>& planes, Vector<3> n, double inradius) {
  n.normalize();
  for (int turn = 0; turn < 3; ++turn, n = Vector<3>(n[2], n[0], n[1]))
    for (int signs = 0; signs < 8; ++signs) {
      const Vector<3> flip(signs & 1 ? -1 : 1, signs & 2 ? -1 : 1, signs & 4 ? -1 : 1);
      const Vector<3> candidate = n.cwiseProduct(flip);
      bool known = false;
      for (const HalfSpace<3>& p : planes)
        known = known || (p.normal - candidate).norm() < 1e-9;
      if (!known) planes.push_back({candidate, inradius});
    }
}

struct Platonic {
  const char* name;
  HalfSpaces<3> planes;
  int vertices;
  double edge, volume, inertia;  // closed forms; inertia about any axis, unit density
};

// the five of inscribed radius r, with their closed forms in the edge a
inline std::vector<Platonic> platonic_solids(double r) {
  const double phi = std::numbers::phi, sqrt2 = std::numbers::sqrt2, sqrt3 = std::numbers::sqrt3,
               sqrt5 = std::sqrt(5.0);
  std::vector<Platonic> list;
  const double n = 1 / sqrt3;
  list.push_back({"tetrahedron",
                  {{{n, n, n}, r}, {{n, -n, -n}, r}, {{-n, n, -n}, r}, {{-n, -n, n}, r}},
                  4,
                  2 * std::sqrt(6.0) * r,
                  1 / (6 * sqrt2),
                  1 / 20.0});
  list.push_back({"cube", cube<3>(r), 8, 2 * r, 1, 1 / 6.0});
  list.push_back({"octahedron", {}, 6, std::sqrt(6.0) * r, sqrt2 / 3, 0.1});
  add_family(list.back().planes, {1, 1, 1}, r);
  list.push_back(
      {"dodecahedron", {}, 20, 2 * r / std::sqrt(2.5 + 1.1 * sqrt5), (15 + 7 * sqrt5) / 4, (39 * phi + 28) / 150});
  add_family(list.back().planes, {0, 1, phi}, r);
  list.push_back({"icosahedron", {}, 12, 2 * sqrt3 * r / (phi * phi), 5 * (3 + sqrt5) / 12, phi * phi / 10});
  add_family(list.back().planes, {1, 1, 1}, r);
  add_family(list.back().planes, {0, 1 / phi, phi}, r);
  for (Platonic& p : list) {
    p.volume *= std::pow(p.edge, 3);
    p.inertia *= p.volume * p.edge * p.edge;
  }
  return list;
}

// apex at (0, 0, height), base a regular polygon of the given inscribed radius in z = 0
inline HalfSpaces<3> pyramid(int sides, double base_radius, double height) {
  HalfSpaces<3> planes{{{0, 0, -1}, 0}};
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    const Vector<3> n = Vector<3>(height * std::cos(angle), height * std::sin(angle), base_radius).normalized();
    planes.push_back({n, n[2] * height});
  }
  return planes;
}

inline HalfSpaces<2> regular_polygon(int sides, double inradius) {
  HalfSpaces<2> planes;
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    planes.push_back({{std::cos(angle), std::sin(angle)}, inradius});
  }
  return planes;
}

// turned about the origin, then moved
template <int Dim>
HalfSpaces<Dim> placed(HalfSpaces<Dim> planes, const Matrix<Dim>& turn, const Vector<Dim>& shift) {
  for (HalfSpace<Dim>& p : planes) {
    p.normal = turn * p.normal;
    p.offset += p.normal.dot(shift);
  }
  return planes;
}

template <int Dim>
HalfSpaces<Dim> scaled(HalfSpaces<Dim> planes, double factor) {
  for (HalfSpace<Dim>& p : planes)
    p.offset *= factor;
  return planes;
}

template <int Dim>
HalfSpaces<Dim> turned_anyhow(const HalfSpaces<Dim>& planes, Random& random) {
  return placed<Dim>(planes, matrix(orientation<Dim>(random)), Vector<Dim>::Zero());
}

// ---- blocks ---------------------------------------------------------------------------------------------------------

// throws when the planes make no block
template <int Dim>
Polytope<Dim> block(const HalfSpaces<Dim>& planes) {
  BlockResult<Dim> result = make_block<Dim>(planes, std::vector<int>(planes.size(), no_joint));
  if (result.status != BlockStatus::ok) throw std::logic_error("the planes make no block");
  return std::move(result.part);
}

// the same with its centroid at the origin, as in a body
template <int Dim>
Polytope<Dim> centred_block(const HalfSpaces<Dim>& planes) {
  const Polytope<Dim> part = block<Dim>(planes);
  return moved_origin<Dim>(part, part.mass.centroid);
}

// the data of a block for contacts, at another size; a power of two changes no digit
template <int Dim>
Polytope<Dim> scaled_block(Polytope<Dim> part, double factor) {
  part.faces = scaled<Dim>(part.faces, factor);
  part.radius *= factor;
  part.inscribed_radius *= factor;
  part.centre *= factor;
  part.vertex_error *= factor;
  for (Vector<Dim>& v : part.vertices)
    v *= factor;
  return part;
}

// the faces that contain all these corners
template <int Dim>
std::vector<int> faces_at(const Polytope<Dim>& part, const std::vector<int>& corners) {
  std::vector<int> faces;
  for (std::size_t f = 0; f < part.loops.size(); ++f)
    if (std::ranges::all_of(corners, [&](int c) { return std::ranges::count(part.loops[f], c) > 0; }))
      faces.push_back(static_cast<int>(f));
  return faces;
}

}  // namespace voussoir::shapes
