// `voussoir import`.
#pragma once

#include "app/base/command.hpp"

namespace voussoir {

// joints of another program's file as a table that scenes read, and a report on stdout
void add_import(CLI::App& program, Action& action);

}  // namespace voussoir
