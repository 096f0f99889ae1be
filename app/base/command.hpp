// What a command gives to the program: arguments, declared to the parser, and what they ask for.
#pragma once

#include <functional>

#include "app/base/exit_codes.hpp"

namespace CLI {
class App;
}

namespace voussoir {

// What the arguments ask for, to be done once all of them are read. Returns the exit code; throws SceneError, BadInput,
// FolderInUse or OutputError.
using Action = std::function<ExitCode()>;

// Adds a command, with its help, to the program; when its arguments are read, `action` is what they ask for.
using AddCommand = void(CLI::App& program, Action& action);

}  // namespace voussoir
