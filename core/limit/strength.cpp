#include "core/limit/strength.hpp"

#include <cmath>
#include <limits>

#include "text/angle.hpp"

namespace voussoir {
namespace {

constexpr double roughest = 89 * degree;  // beyond it a cone is a half-space
constexpr double angle_tolerance = 1e-6 * degree;
constexpr double most_strength = 1000.0 / 1001;
constexpr double strength_tolerance = 2e-8;

}  // namespace

template <int Dim>
Strength<Dim> friction_of(const std::vector<bool>& chosen) {
  const auto weaken = [chosen](double friction, CornerAssembly<Dim>& trial) {
    for (std::size_t f = 0; f < trial.faces.size(); ++f)
      if (chosen[f]) trial.faces[f].friction = friction;
  };
  const auto slope = [chosen](double, const std::vector<Sensitivity>& of_faces) {
    double sum = 0;
    for (std::size_t f = 0; f < of_faces.size(); ++f)
      if (chosen[f]) sum += of_faces[f].friction;
    return sum;
  };
  return {roughest, angle_tolerance, chosen, weaken, slope};
}

template <int Dim>
Strength<Dim> remaining_strength(const CornerAssembly<Dim>& assembly, const std::vector<bool>& chosen) {
  const auto weaken = [&assembly, chosen](double at, CornerAssembly<Dim>& trial) {
    const double left = at / (1 - at);
    for (std::size_t f = 0; f < trial.faces.size(); ++f) {
      if (!chosen[f]) continue;
      trial.faces[f].friction = std::atan(left * std::tan(assembly.faces[f].friction));
      trial.faces[f].cohesion = left * assembly.faces[f].cohesion;
    }
  };
  const auto slope = [&assembly, chosen](double at, const std::vector<Sensitivity>& of_faces) {
    const double left = at / (1 - at);
    double sum = 0;
    for (std::size_t f = 0; f < of_faces.size(); ++f) {
      if (!chosen[f]) continue;
      const double tangent = std::tan(assembly.faces[f].friction), weaker = left * tangent;
      sum += of_faces[f].friction * tangent / (1 + weaker * weaker);
      if (left > 0) sum += of_faces[f].cohesion / left;
    }
    return sum / ((1 - at) * (1 - at));
  };
  return {most_strength, strength_tolerance, chosen, weaken, slope};
}

double factor_at(double remaining_strength) {
  return remaining_strength > 0 ? (1 - remaining_strength) / remaining_strength
                                : std::numeric_limits<double>::infinity();
}

template Strength<2> friction_of(const std::vector<bool>&);
template Strength<3> friction_of(const std::vector<bool>&);
template Strength<2> remaining_strength(const CornerAssembly<2>&, const std::vector<bool>&);
template Strength<3> remaining_strength(const CornerAssembly<3>&, const std::vector<bool>&);

}  // namespace voussoir
