// A short name for the state of a simulation: equal hashes mean equal bits, from any program.
#pragma once

#include <string>

#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// The fingerprint ("fnv1a64:…") of the bits of every present body's motion, by id, and of the key, shear force, normal,
// point and plastic slip of every contact that touches, by key. Candidates, proofs, names and the numbers of joints and
// properties are left out: they change with the settings or the order of input, the physics must not. Bits, not values:
// -0 differs from 0.
template <int Dim>
std::string state_hash(const Model<Dim>& model, const State<Dim>& state);

}  // namespace voussoir
