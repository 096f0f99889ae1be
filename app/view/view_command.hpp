// `voussoir view`.
#pragma once

#include "app/base/command.hpp"

namespace voussoir {

// the page in which the blocks of a run can be turned, from what the run has kept for it
void add_view(CLI::App& program, Action& action);

}  // namespace voussoir
