// `voussoir check`.
#pragma once

#include "app/base/command.hpp"

namespace voussoir {

// reports the features a scene uses, a forecast of the run, and likely mistakes; writes nothing
void add_check(CLI::App& program, Action& action);

}  // namespace voussoir
