#include "core/model/supports_state.hpp"

namespace voussoir {

BeamNode moved_node(const BodiesState<2>& bodies, int body) {
  return {bodies.motions[body].displacement, bodies.motions[body].rotation.angle};
}

std::vector<BeamForces> forces_of_beams(const Lining& lining, const BodiesState<2>& bodies) {
  std::vector<BeamForces> all;
  for (int k = 0; k < lining.beams(); ++k) {
    const Beam beam = lining.beam(k);
    all.push_back(beam_forces(beam, beam_strain(beam, moved_node(bodies, lining.first_body + k),
                                                moved_node(bodies, lining.first_body + lining.next(k)))));
  }
  return all;
}

}  // namespace voussoir
