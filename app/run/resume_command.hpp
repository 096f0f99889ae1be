// `voussoir resume`.
#pragma once

#include "app/base/command.hpp"

namespace voussoir {

// continues an interrupted run, from its last checkpoint or from its begin; a complete one is left
// unchanged
void add_resume(CLI::App& program, Action& action);

}  // namespace voussoir
