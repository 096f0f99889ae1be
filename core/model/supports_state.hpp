// The supports that stages have installed.
#pragma once

#include <vector>

#include "core/model/bodies_state.hpp"
#include "core/support/grouted_bolt.hpp"
#include "core/support/lining.hpp"

namespace voussoir {

template <int Dim>
struct SupportsState {
  std::vector<BoltSpring<Dim>> bolt_springs;  // of the bolts installed so far, in their order
  std::vector<GroutedBolt<Dim>> grouted;      // bars of those that are grouted, in the order of their springs
  std::vector<LiningState> linings;           // installed so far
};

// a body as a node of a lining
BeamNode moved_node(const BodiesState<2>& bodies, int body);

// the forces of an installed lining's beams, in their order
std::vector<BeamForces> forces_of_beams(const Lining& lining, const BodiesState<2>& bodies);

}  // namespace voussoir
