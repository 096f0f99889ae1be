// A command of the program: arguments, declared to the parser, and the action they ask for.
#pragma once

#include <functional>

#include "app/base/exit_codes.hpp"

namespace CLI {
class App;
}

namespace voussoir {

// The action of a command, run once all arguments are read. Returns the exit code; throws SceneError, BadInput,
// FolderInUse or OutputError.
using Action = std::function<ExitCode()>;

// Adds a command, with its help, to the program; when its arguments are read, `action` is set to their action.
using AddCommand = void(CLI::App& program, Action& action);

}  // namespace voussoir
