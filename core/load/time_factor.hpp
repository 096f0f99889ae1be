// A factor that varies with time, of loads and of prescribed motions.
#pragma once

#include "core/base/settings.hpp"

namespace voussoir {

// at a time since the stage began, s
double value_at(const TimeFactor& factor, double time);

// its mean between two times, `to` after `from`: exact
double mean_of(const TimeFactor& factor, double from, double to);

}  // namespace voussoir
