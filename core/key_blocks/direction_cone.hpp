// The cone of directions in which a block can move without closing a joint, K = {v : n_i·v >= 0}, n_i the unit normals
// into the block of the faces by which it lies on other rock (Goodman & Shi's joint pyramid), and the projection of its
// load R onto it (Gauss's principle, Moreau's theorem):
//
//   R = v - Σ N_i n_i,   v in K,   N_i >= 0,   N_i (n_i·v) = 0                                                (1)
//
// v is unique. |v| is the driving force, v/|v| the direction of frictionless motion from rest, N_i the normal forces.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/geometry/types.hpp"

namespace voussoir {

// The sine of the angle by which a face may be closed. Parallel faces of one set are parallel to 1e-16 only, faces of
// tables to the digits written; an exact rule would hold a drawer between two of them. Nothing physical depends on it.
inline constexpr double closing_tolerance = 1e-9;

template <int Dim>
struct Projection {
  bool found = true;                         // false: the limit of steps was reached
  Vector<Dim> motion = Vector<Dim>::Zero();  // v, in the unit of the load; zero: K holds the load
  int loaded = 0;                            // number of faces with N_i > 0
  std::array<int, Dim> faces{};              // them
  std::array<double, Dim> forces{};          // N_i
  int steps = 0;                             // of the active set
};

// Lawson & Hanson's active set over at most Dim faces.
template <int Dim>
Projection<Dim> project(const std::vector<Vector<Dim>>& normals, const Vector<Dim>& load);

// The forces N on these faces, at most Dim, that balance the part of the load in the span of their normals; false if
// the normals are dependent.
template <int Dim>
bool balance(const std::vector<Vector<Dim>>& normals, const std::array<int, Dim>& faces, int count,
             const Vector<Dim>& load, std::array<double, Dim>& forces);

// Whether K holds more than 0, with its proof: a direction of K, or a positive weight of every face with
// Σ weight_i n_i = 0 for normals that span the space.
template <int Dim>
struct Removability {
  bool found = true;  // false: the limit of steps was reached
  bool removable = false;
  Vector<Dim> direction = Vector<Dim>::Zero();  // unit, if removable
  std::vector<double> weights;                  // else
};
template <int Dim>
Removability<Dim> find_removability(const std::vector<Vector<Dim>>& normals);

// rad: a block that is not removable is free if every one of its planes is wrong by this angle; nothing if it is
// removable. sin ε = 1/(distance of the farthest corner of {x : -n_i·x <= 1}).
template <int Dim>
std::optional<double> find_taper(const std::vector<Vector<Dim>>& normals);

}  // namespace voussoir
