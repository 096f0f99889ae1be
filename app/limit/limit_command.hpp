// `voussoir limit`.
#pragma once

#include "app/base/command.hpp"

namespace voussoir {

// the collapse load or critical friction of a scene in the plane by rigid-block limit analysis, with its forces and
// mechanism
void add_limit(CLI::App& program, Action& action);

}  // namespace voussoir
