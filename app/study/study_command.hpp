// `voussoir study` and its parts.
#pragma once

#include "app/base/command.hpp"

namespace voussoir {

// runs a scene as it is and with one setting changed at a time, in parallel processes; writes study.csv. Completed
// runs are kept as long as scene and program are the same.
void add_study(CLI::App& program, Action& action);

}  // namespace voussoir
