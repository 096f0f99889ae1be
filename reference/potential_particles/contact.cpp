#include "reference/potential_particles/contact.hpp"

#include <algorithm>
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

RoundedForm rounded_features(double sphericity, double part_a, double part_b, double gap) {
  const double planes = 1 - sphericity;
  const double apart = sphericity * (part_b - part_a) / (planes * gap);  // T_A - T_B
  const double surfaces = std::sqrt((1 - sphericity * part_a) / planes) + std::sqrt((1 - sphericity * part_b) / planes);
  return {(gap + apart) / 2, (gap - apart) / 2, surfaces - gap};
}

double tilt(double sphericity, double along, double sphere_radius, double from_feature) {
  return sphericity * along / (sphere_radius * sphere_radius * (1 - sphericity) * from_feature);
}

double recess(int faces, double corner_radius) {
  return (std::sqrt(static_cast<double>(faces)) - 1) * corner_radius;
}

double unlinked_spheres(double radius_a, double radius_b, double distance) {
  return radius_a > radius_b ? distance : 0;
}

double unlinked_squares(double length_a, double length_b, double gap) {
  const double a = length_a * length_a, b = length_b * length_b;
  return a / (a + b) * gap;
}

double unseen_overlap(double length_a, double length_b) {
  const double smaller = std::min(length_a, length_b), larger = std::max(length_a, length_b);
  return smaller * (1 - smaller / larger);
}

}  // namespace voussoir::reference
