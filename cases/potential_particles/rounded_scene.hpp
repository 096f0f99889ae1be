// Scenes whose half-space blocks are replaced by potential particles of the same faces.
#pragma once

#include <string>

#include "core/potential/shape.hpp"
#include "core/run/simulate.hpp"

namespace voussoir::cases {

struct Rounding {
  double radius = 0;      // r, m; 0: the half-space blocks themselves
  double sphericity = 0;  // k
};

// The potential particle of a sharp body: the middle of each rounded face is on the sharp one. If the foot of the
// perpendicular from the sphere's centre is D away, its plane is u = r sqrt((1 - k D²/R²)/(1 - k)) inside; R is the
// least that encloses. Throws std::domain_error if some u exceeds D: there is no such body.
template <int Dim>
PotentialShape<Dim> rounded(const HalfSpaces<Dim>& faces, const Vector<Dim>& centre, const Rounding& rounding);

// The blocks of a model in their current positions, rounded about their centroids, as lines of a scene's `blocks`;
// those without a name are named after their index in the model ("block_0").
template <int Dim>
std::string blocks_as_particles(const Model<Dim>& model, const State<Dim>& state, const Rounding& rounding);

// Bound of the error of volume and inertia, over the volume; the error itself is a hundred times smaller. In space 1e-4
// takes a second for five bodies, and no test here needs more.
template <int Dim>
inline constexpr double mass_tolerance = Dim == 2 ? 1e-4 : 1e-2;

// the smallest inscribed radius of the bodies that are not fixed, m
template <int Dim>
double smallest_size(const Model<Dim>& model);

}  // namespace voussoir::cases
