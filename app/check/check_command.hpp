// `voussoir check`.
#pragma once

#include "app/base/exit_codes.hpp"
#include "app/base/scene_arguments.hpp"

namespace voussoir {

// says what a scene activates, what follows from its numbers, and what looks wrong; writes nothing
ExitCode check_command(const SceneArguments& arguments);

}  // namespace voussoir
