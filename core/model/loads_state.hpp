// The forces and moments on bodies.
#pragma once

#include <vector>

#include "core/base/energy.hpp"
#include "core/load/load.hpp"

namespace voussoir {

// of bodies, by source
template <int Dim>
using LoadsBySource = BySource<std::vector<Load<Dim>>, load_count>;

// The relief load on a body that excavated rock supported.
template <int Dim>
struct ReliefLoad {
  int body = 0;
  Load<Dim> load;    // at a share of 1; it keeps its direction and acts at the centroid
  double begun = 1;  // the share when the stage began
  double share = 1;  // that acts now
};

template <int Dim>
struct LoadsState {
  std::vector<Load<Dim>> total;          // by body: of all sources together, before damping
  LoadsBySource<Dim> by_source;          // by body; empty for a source that the scene does not use
  std::vector<BodyStiffness> stiffened;  // by body: added by loads other than the contacts; empty if none adds any
  std::vector<ReliefLoad<Dim>> relief;   // by excavation, then by body
};

}  // namespace voussoir
