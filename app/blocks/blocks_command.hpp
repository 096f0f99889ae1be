// `voussoir blocks`.
#pragma once

#include "app/base/command.hpp"

namespace voussoir {

// judges every block of a sliced mass by block theory and writes the verdicts with their proofs
void add_blocks(CLI::App& program, Action& action);

}  // namespace voussoir
