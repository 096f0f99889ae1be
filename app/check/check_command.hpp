// `voussoir check`.
#pragma once

#include "app/base/command.hpp"

namespace voussoir {

// says what a scene activates, what follows from its numbers, and what looks wrong; writes nothing
void add_check(CLI::App& program, Action& action);

}  // namespace voussoir
