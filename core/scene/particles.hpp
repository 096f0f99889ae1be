// Blocks that are potential particles, from their scene tables.
#pragma once

#include "core/model/model.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir {

// keys that the table of one block must state together
void check_particle_keys(const BlockSpec& block);

// The part of a block of shape = "potential", seen from `origin`, without mass and drawing; `planes` of any length.
// Throws SceneError if the numbers do not define a particle.
template <int Dim>
Polytope<Dim> make_particle_part(const BlockSpec& block, HalfSpaces<Dim> planes, const Vector<Dim>& origin);

// the same part with both
template <int Dim>
Polytope<Dim> finish_particle(const BlockSpec& block, Polytope<Dim> part);

// Gives each half-space part of a model with particles an inner particle, for contacts with these.
template <int Dim>
void add_inner_particles(const ContactSettings& settings, Model<Dim>& model);

}  // namespace voussoir
