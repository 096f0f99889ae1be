#include "core/geometry/facet_weights.hpp"

namespace voussoir {

// Every pair is asked at every step: faces are in the order of their normals (slicing/block.hpp), so that only
// neighbours in it are compared.
template <int Dim>
bool has_facets(const Polytope<Dim>& part) {
  const HalfSpaces<Dim>& faces = part.faces;
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (std::size_t j = i + 1; j < faces.size() && faces[j].normal[0] - faces[i].normal[0] < leans_apart; ++j)
      if ((faces[j].normal - faces[i].normal).squaredNorm() < leans_apart * leans_apart) return true;
  return false;
}

template <int Dim>
void append_weights(const Polytope<Dim>& part, std::vector<double>& weights) {
  for (const HalfSpace<Dim>& face : part.faces) {
    double sum = 0;
    for (const HalfSpace<Dim>& other : part.faces)
      if (const double angle = (other.normal - face.normal).norm(); angle < leans_apart) sum += 1 - angle / leans_apart;
    weights.push_back(1 / sum);
  }
}

template <int Dim>
void facet_weights(const Polytope<Dim>& a, const Polytope<Dim>& b, std::vector<double>& weights) {
  weights.clear();
  if (!has_facets(a) && !has_facets(b)) return;
  append_weights(a, weights);
  append_weights(b, weights);
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                \
  template bool has_facets<Dim>(const Polytope<Dim>&);                           \
  template void append_weights<Dim>(const Polytope<Dim>&, std::vector<double>&); \
  template void facet_weights<Dim>(const Polytope<Dim>&, const Polytope<Dim>&, std::vector<double>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
