#include <cstdio>

#include "app/commands/commands.hpp"
#include "core/scene/scene.hpp"

namespace voussoir {

ExitCode docs_command() {
  std::fputs(scene_documentation().c_str(), stdout);
  return ExitCode::done;
}

}  // namespace voussoir
