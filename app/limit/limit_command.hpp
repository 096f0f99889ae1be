// `voussoir limit`.
#pragma once

#include "app/base/command.hpp"

namespace voussoir {

// collapse load, factor of safety or critical friction of a scene by rigid-block limit analysis, with forces and
// mechanism
void add_limit(CLI::App& program, Action& action);

}  // namespace voussoir
