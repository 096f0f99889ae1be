#include <cstdlib>
#include <string_view>

#include "app/commands/command_line.hpp"
#include "core/base/floating_point_traps.hpp"

int main(int argument_count, char** arguments) {
  // as in the tests: stop at the first NaN or infinity
  const char* traps = std::getenv("VOUSSOIR_TRAPS");
  if (traps && std::string_view(traps) == "1") voussoir::trap_floating_point_errors();
  return voussoir::command_line(argument_count, arguments);
}
