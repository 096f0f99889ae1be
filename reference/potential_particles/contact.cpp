#include "reference/potential_particles/contact.hpp"

#include <cmath>

namespace voussoir::reference {

PotentialContactForm touching_spheres(double radius_a, double radius_b, double distance) {
  const double both = radius_a + radius_b;
  return {radius_a / both * distance, both - distance, (distance / both) * (distance / both) - 1};
}

PotentialContactForm touching_features(double corner_radius_a, double corner_radius_b, double gap) {
  const double both = corner_radius_a + corner_radius_b;
  return {corner_radius_a / both * gap, both - gap, (gap / both) * (gap / both) - 1};
}

double recess(int faces, double corner_radius) {
  return (std::sqrt(static_cast<double>(faces)) - 1) * corner_radius;
}

double unlinked_spheres(double radius_a, double radius_b, double distance) {
  return radius_a > radius_b ? distance : 0;
}

}  // namespace voussoir::reference
