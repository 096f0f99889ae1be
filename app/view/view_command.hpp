// `voussoir view`.
#pragma once

#include "app/base/command.hpp"

namespace voussoir {

// the interactive 3-D page of a run's blocks, from the file that the run kept for it
void add_view(CLI::App& program, Action& action);

}  // namespace voussoir
