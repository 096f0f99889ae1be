#include "core/geometry/facet_weights.hpp"

namespace voussoir {

template <int Dim>
std::vector<double> facet_weights(const HalfSpaces<Dim>& faces) {
  std::vector<double> weights;
  bool some = false;
  for (const HalfSpace<Dim>& face : faces) {
    double sum = 1;
    for (const HalfSpace<Dim>& other : faces) {
      if (&other == &face) continue;
      const double angle = (other.normal - face.normal).norm();
      if (angle < leans_apart) sum += 1 - angle / leans_apart;
    }
    weights.push_back(1 / sum);
    some = some || sum > 1;
  }
  if (!some) weights.clear();
  return weights;
}

template std::vector<double> facet_weights<2>(const HalfSpaces<2>&);
template std::vector<double> facet_weights<3>(const HalfSpaces<3>&);

}  // namespace voussoir
