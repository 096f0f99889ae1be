// Unloaded faces that the elastic shear of the loaded ones closes: a run then differs from limit equilibrium.
#pragma once

#include <optional>
#include <vector>

#include "core/key_blocks/verdict.hpp"

namespace voussoir {

// m, of a sliding block on its loaded faces: d of Σ A_i [kn n nᵀ + ks (I - n nᵀ)] d = load. Nothing if it does not
// slide, or a loaded face's stiffness is not constant per area.
template <int Dim>
std::optional<Vector<Dim>> elastic_displacement(const Assembly<Dim>& assembly, const Block<Dim>& block,
                                                const BoltedVerdict<Dim>& bolted);

// Faces of Block::faces, ascending, into which a sliding block moves by that displacement; empty without it.
template <int Dim>
std::vector<int> closed_by_elastic_shear(const Assembly<Dim>& assembly, const Block<Dim>& block,
                                         const BoltedVerdict<Dim>& bolted);

// the unloaded face that the motion opens least
struct Opening {
  int face = -1;     // in Block::faces; -1: there is none
  double angle = 0;  // rad
};
template <int Dim>
Opening opening_angle(const Block<Dim>& block, const Verdict<Dim>& verdict);

}  // namespace voussoir
