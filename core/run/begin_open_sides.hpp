// Sides that waves leave, when the stage begins that opens them.
#pragma once

#include <string>
#include <vector>

#include "core/run/stage_in_force.hpp"

namespace voussoir {

// The state of the sides that this stage opens: plates without force; the columns with the motion and the joints of the
// side's blocks; and as constant loads what balances the bodies whose support or stress the side replaces, and the
// columns, all of them at rest. The state has the model's bodies.
template <int Dim>
void begin_open_sides(const StageInForce<Dim>& stage, State<Dim>& state);

// At the end of a stage, a line for each quiet side that creeps: by more than a thousandth of its smallest block beyond
// twice the displacement of the waves that entered in the stage.
template <int Dim>
std::vector<std::string> creep_of(const StageInForce<Dim>& stage, const State<Dim>& state);

// A line for each side that this stage opens whose medium was estimated: which speeds were used.
template <int Dim>
std::vector<std::string> estimated_media(const StageInForce<Dim>& stage);

}  // namespace voussoir
