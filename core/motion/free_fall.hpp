// Bodies whose motion says why a run finds no rest.
#pragma once

#include "core/model.hpp"
#include "core/state.hpp"

namespace voussoir {

// A body that can never come to rest, or -1: its weight alone acts on it, it has come farther along gravity than the
// whole model is wide, all bodies included, it still goes that way, and nothing that could catch it lies ahead. What
// is prescribed might, so that with prescribed motions there is no such body.
template <int Dim>
int falling_free(const Model<Dim>& model, const State<Dim>& state);

// the free body with the fastest point, or -1 where all stand
template <int Dim>
int fastest(const Model<Dim>& model, const State<Dim>& state);

}  // namespace voussoir
