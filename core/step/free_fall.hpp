// Bodies whose motion says why a run finds no rest.
#pragma once

#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// A body that can never come to rest, or -1: no contact, support or water exerts a force on it, other loads (weight,
// stress, applied forces, relief) do, and it has come farther than the whole model is wide, all bodies included, is not
// on its way back, and nothing lies below it in their direction; or it is a thousand times as far. What is prescribed
// might catch it, so that with prescribed motions there is no such body.
template <int Dim>
int falling_free(const Model<Dim>& model, const State<Dim>& state);

// A body that can only fall, or -1: it has weight, no chain of candidate contacts, bolts and linings ties it to a body
// that is held or driven, its weight alone acts on what it is tied to, and below none of that lies a body that does not
// fall likewise. The state's candidates and loads have been found; where waters or prescribed motions may catch it
// there is no such body.
template <int Dim>
int tied_to_nothing(const Model<Dim>& model, const State<Dim>& state);

// the free body with the fastest point, or -1 where all stand
template <int Dim>
int fastest(const Model<Dim>& model, const State<Dim>& state);

}  // namespace voussoir
