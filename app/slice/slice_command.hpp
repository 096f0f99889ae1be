// `voussoir slice`.
#pragma once

#include "app/base/command.hpp"

namespace voussoir {

// cuts the blocks and writes them with a table of their sizes; on request in other formats, and a report on the joints
void add_slice(CLI::App& program, Action& action);

}  // namespace voussoir
