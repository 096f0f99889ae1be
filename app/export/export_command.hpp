// `voussoir export`.
#pragma once

#include "app/base/command.hpp"

namespace voussoir {

// a scene's blocks, joints and properties as text for another program
void add_export(CLI::App& program, Action& action);

}  // namespace voussoir
