// `voussoir resume`.
#pragma once

#include "app/base/command.hpp"

namespace voussoir {

// continues with a run that was interrupted, from its last checkpoint or from its begin; a complete one is left as it
// is
void add_resume(CLI::App& program, Action& action);

}  // namespace voussoir
