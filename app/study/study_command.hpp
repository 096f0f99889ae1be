// `voussoir study` and its parts.
#pragma once

#include "app/base/command.hpp"

namespace voussoir {

// runs a scene as it is and with one setting changed at a time, in processes side by side; writes study.csv. What was
// done before is kept while scene and program are the same.
void add_study(CLI::App& program, Action& action);

}  // namespace voussoir
