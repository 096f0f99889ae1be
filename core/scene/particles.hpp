// Blocks that are potential particles, from what a scene states of them.
#pragma once

#include "core/model/model.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir {

// what the table of one block must state together
void check_particle_keys(const BlockSpec& block);

// The part that a block of shape = "potential" is, seen from `origin`, its mass and drawing left out; `planes` of any
// length. Throws SceneError where the numbers make no particle.
template <int Dim>
Polytope<Dim> make_particle_part(const BlockSpec& block, HalfSpaces<Dim> planes, const Vector<Dim>& origin);

// the same part with both
template <int Dim>
Polytope<Dim> finish_particle(const BlockSpec& block, Polytope<Dim> part);

// Gives the parts of half-spaces of a model with particles what they are to these.
template <int Dim>
void add_inner_particles(const ContactSettings& settings, Model<Dim>& model);

}  // namespace voussoir
