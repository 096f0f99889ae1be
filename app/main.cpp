#include "app/commands/command_line.hpp"

int main(int argument_count, char** arguments) {
  return voussoir::command_line(argument_count, arguments);
}
