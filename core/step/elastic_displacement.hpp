// How far the loads on a model in equilibrium move its elastic model: the length over which a search brings up the
// strength of joints and bolts.
#pragma once

#include <vector>

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// m, by body: the displacement K⁻¹ f, with K the tangent of all joints and supports under a friction that lets none of
// them slip, and f all loads but theirs; 0 for a body that is held. A body that nothing ties has no such displacement:
// its value is very large. The state is in equilibrium.
template <int Dim>
std::vector<double> elastic_displacements(const Model<Dim>& model, const Settings& settings, State<Dim> state);

}  // namespace voussoir
