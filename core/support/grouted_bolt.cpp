#include "core/support/grouted_bolt.hpp"

#include <algorithm>

namespace voussoir {

template <int Dim>
void bound_stiffness(GroutedBolt<Dim>& g, GroutWorkspace& workspace) {
  g.stiffness.clear();
  for (int s = 0; s <= g.joints(); ++s) {
    const auto [first, last] = std::equal_range(g.stretch.begin(), g.stretch.end(), s);
    g.stiffness.push_back(elastic_stiffness(g.bar, static_cast<int>(first - g.stretch.begin()),
                                            static_cast<int>(last - g.stretch.begin()), workspace));
  }
}

template <int Dim>
GroutedBolt<Dim> piece_of(const GroutedBolt<Dim>& grouted, int first, int last, GroutWorkspace& workspace) {
  GroutedBolt<Dim> piece = grouted;
  keep_nodes(first, last, piece.bar, piece.state);
  piece.body.assign(grouted.body.begin() + first, grouted.body.begin() + last);
  piece.place.assign(grouted.place.begin() + first, grouted.place.begin() + last);
  piece.stretch.assign(grouted.stretch.begin() + first, grouted.stretch.begin() + last);
  for (int& stretch : piece.stretch)
    stretch -= grouted.stretch[first];
  if (!is_held(piece.bar)) return piece;
  settle(piece.bar, piece.state, workspace);
  bound_stiffness(piece, workspace);
  return piece;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                         \
  template void bound_stiffness<Dim>(GroutedBolt<Dim>&, GroutWorkspace&); \
  template GroutedBolt<Dim> piece_of<Dim>(const GroutedBolt<Dim>&, int, int, GroutWorkspace&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
