// A factor that varies with time, of loads and of prescribed motions.
#pragma once

#include "core/base/settings.hpp"

namespace voussoir {

// at a time since the stage began, s
double value_at(const TimeFactor& factor, double time);

}  // namespace voussoir
