#include <fmt/format.h>

#include "app/commands/commands.hpp"
#include "core/scene/scene.hpp"

namespace voussoir {

ExitCode docs_command() {
  fmt::print("{}", scene_documentation());
  return ExitCode::done;
}

}  // namespace voussoir
