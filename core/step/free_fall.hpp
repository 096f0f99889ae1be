// Bodies whose motion explains why a run does not reach equilibrium.
#pragma once

#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// A body that cannot reach equilibrium, or -1: no contact, support or water exerts a force on it, other loads (weight,
// stress, applied forces, relief) do, and it has moved farther than the width of the whole model, does not return, and
// has nothing below it in their direction; or it is a thousand times as far. A prescribed motion might catch it, so
// that with prescribed motions there is no such body.
template <int Dim>
int falling_free(const Model<Dim>& model, const State<Dim>& state);

// A body that can only fall, or -1: it has weight, no chain of candidate contacts, bolts and linings connects it to a
// fixed or driven body, only weight acts on the bodies of its chain, and there is no body below them that does not fall
// likewise. The state's candidates and loads have been found; if waters or prescribed motions may catch it there is no
// such body.
template <int Dim>
int tied_to_nothing(const Model<Dim>& model, const State<Dim>& state);

// the free body with the fastest point, or -1 if none moves
template <int Dim>
int fastest(const Model<Dim>& model, const State<Dim>& state);

}  // namespace voussoir
