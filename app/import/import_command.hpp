// `voussoir import`.
#pragma once

#include "app/base/command.hpp"

namespace voussoir {

// converts joints of another program's file into a table for scenes, with a report on stdout
void add_import(CLI::App& program, Action& action);

}  // namespace voussoir
