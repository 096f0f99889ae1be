#include "core/potential/particle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace voussoir {
namespace {

// Σ <a·x - d>² grows by no more than the largest eigenvalue of Σ a aᵀ, which the largest sum of a row bounds
template <int Dim>
double steepness_of(const PotentialShape<Dim>& shape) {
  const PlacedPotential<Dim> own = placed<Dim>(shape);
  Matrix<Dim> spread = Matrix<Dim>::Zero();
  for (const HalfSpace<Dim>& plane : own.planes)
    spread += plane.normal * plane.normal.transpose();
  return std::sqrt(own.plane_weight * spread.cwiseAbs().rowwise().sum().maxCoeff() + own.sphere_weight);
}

template <int Dim>
PotentialMass<Dim> mass_of_sphere(const PotentialShape<Dim>& shape) {
  constexpr double pi = std::numbers::pi;
  const double radius = shape.sphere_radius, square = radius * radius;
  PotentialMass<Dim> sphere;
  MassProperties<Dim>& mass = sphere.mass;
  mass.volume = Dim == 3 ? 4.0 / 3 * pi * square * radius : pi * square;
  mass.centroid = shape.centre;
  mass.second_moment = mass.volume * (square / (Dim + 2) * Matrix<Dim>::Identity() +
                                      Matrix<Dim>(shape.centre * shape.centre.transpose()));
  return sphere;
}

template <int Dim>
bool equal(const PotentialShape<Dim>& a, const PotentialShape<Dim>& b) {
  return a.corner_radius == b.corner_radius && a.sphericity == b.sphericity && a.sphere_radius == b.sphere_radius &&
         a.centre == b.centre &&
         std::equal(a.planes.begin(), a.planes.end(), b.planes.begin(), b.planes.end(),
                    [](const HalfSpace<Dim>& p, const HalfSpace<Dim>& q) {
                      return p.normal == q.normal && p.offset == q.offset;
                    });
}

}  // namespace

template <int Dim>
Particle<Dim> make_particle(const PotentialShape<Dim>& shape) {
  return {shape, false, steepness_of<Dim>(shape), {}, {}};
}

template <int Dim>
PotentialMass<Dim> mass_of(const PotentialShape<Dim>& shape, double tolerance) {
  if (shape.sphericity == 1) return mass_of_sphere<Dim>(shape);
  struct Known {
    PotentialShape<Dim> shape;
    double tolerance;
    PotentialMass<Dim> mass;
  };
  constexpr std::size_t most_known = 64;
  static thread_local std::vector<Known> known;
  for (const Known& k : known)
    if (k.tolerance == tolerance && equal<Dim>(k.shape, shape)) return k.mass;
  if (known.size() == most_known) known.erase(known.begin());
  known.push_back({shape, tolerance, integrate<Dim>(shape, tolerance)});
  return known.back().mass;
}

template <int Dim>
Particle<Dim> inner_particle(const Polytope<Dim>& part, double fraction) {
  PotentialShape<Dim> shape;
  shape.corner_radius = fraction * part.inscribed_radius;
  // Σ w <a·x - d>²: facets of one face would else end it r / √m outside their planes, not r
  for (std::size_t f = 0; f < part.faces.size(); ++f) {
    const HalfSpace<Dim>& face = part.faces[f];
    const double root = part.face_weights.empty() ? 1 : std::sqrt(part.face_weights[f]);
    shape.planes.push_back(
        {root * face.normal, root * (face.offset - face.normal.dot(part.centre) - shape.corner_radius)});
  }
  for (const Vector<Dim>& v : part.vertices)
    shape.sphere_radius = std::max(shape.sphere_radius, (v - part.centre).norm());
  Particle<Dim> particle = make_particle<Dim>(shape);
  particle.inner = true;
  return particle;
}

template <int Dim>
double outside_by(const Polytope<Dim>& part, const Vector<Dim>& point) {
  const double f = value<Dim>(placed<Dim>(part.particle->shape), point - part.centre);
  return f / (std::sqrt(1 + std::max(f, 0.0)) + 1) / part.particle->steepness;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                               \
  template Particle<Dim> make_particle<Dim>(const PotentialShape<Dim>&);        \
  template PotentialMass<Dim> mass_of<Dim>(const PotentialShape<Dim>&, double); \
  template Particle<Dim> inner_particle<Dim>(const Polytope<Dim>&, double);     \
  template double outside_by<Dim>(const Polytope<Dim>&, const Vector<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
