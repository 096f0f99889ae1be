// Seeded inputs of the benchmarks: regular and joint-cut polyhedra, pairs at a given overlap.
#pragma once

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "core/contact/narrow_phase.hpp"
#include "core/slicing/block.hpp"

namespace voussoir::benchmarks {

using Random = boost::random::mt19937_64;

inline double uniform(Random& random, double low, double high) {
  return boost::random::uniform_real_distribution<double>(low, high)(random);
}

inline Vector<3> direction(Random& random) {
  while (true) {
    const Vector<3> v(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
    if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
  }
}

// circumradius 0.5: size 1
inline Polytope<3> from_vertices(std::vector<Vector<3>> vertices) {
  for (Vector<3>& v : vertices)
    v *= 0.5 / v.norm();
  const HalfSpaces<3> planes = hull_planes<3>(vertices);
  const BlockResult<3> block = make_block<3>(planes, std::vector<int>(planes.size(), no_joint));
  if (block.status != BlockStatus::ok) throw std::logic_error("benchmark shape");
  return block.part;
}

// 0 tetrahedron, 1 cube, 2 octahedron, 3 dodecahedron, 4 icosahedron
inline Polytope<3> platonic(int kind) {
  const double g = 0.5 * (1 + std::sqrt(5.0));
  std::vector<Vector<3>> v;
  const auto signs = [&](double x, double y, double z) {
    for (int s = 0; s < 8; ++s) {
      const Vector<3> p(s & 1 ? -x : x, s & 2 ? -y : y, s & 4 ? -z : z);
      bool known = false;
      for (const Vector<3>& q : v)
        known = known || (q - p).norm() < 1e-12;
      if (!known) v.push_back(p);
    }
  };
  switch (kind) {
    case 0:
      v = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
      break;
    case 1:
      signs(1, 1, 1);
      break;
    case 2:
      signs(1, 0, 0), signs(0, 1, 0), signs(0, 0, 1);
      break;
    case 3:
      signs(1, 1, 1), signs(0, 1 / g, g), signs(1 / g, g, 0), signs(g, 0, 1 / g);
      break;
    default:
      signs(0, 1, g), signs(1, g, 0), signs(g, 0, 1);
      break;
  }
  return from_vertices(v);
}

inline const char* platonic_name(int kind) {
  static const char* const names[] = {"tetrahedron", "cube", "octahedron", "dodecahedron", "icosahedron"};
  return names[kind];
}

// Two equal parts, randomly turned, pushed together along a random direction until the LP's optimum is -depth (positive
// depth: overlap; negative: gap).
inline Pair<3> pair_at(const Polytope<3>& part, double depth, Random& random) {
  Pair<3> pair;
  pair.a = pair.b = &part;
  pair.axes.setIdentity();
  pair.rotation = Eigen::AngleAxisd(uniform(random, 0, 3), direction(random)).toRotationMatrix();
  const Vector<3> along = direction(random);
  double near = 0, far = 2;
  HalfSpaces<3> planes;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (near + far);
    pair.offset = middle * along;
    assemble<3>(pair, 0.5 * pair.offset, planes);
    (solve_feasibility<3>(planes, {}).value < -depth ? near : far) = middle;
  }
  pair.offset = near * along;
  return pair;
}

}  // namespace voussoir::benchmarks
