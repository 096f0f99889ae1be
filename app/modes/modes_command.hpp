// `voussoir modes`.
#pragma once

#include "app/base/command.hpp"

namespace voussoir {

// lowest natural frequencies and mode shapes of a scene's state at rest
void add_modes(CLI::App& program, Action& action);

}  // namespace voussoir
