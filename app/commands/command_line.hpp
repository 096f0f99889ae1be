// The command line: arguments in, exit code out, every error as one line on stderr.
#pragma once

namespace voussoir {

int command_line(int argument_count, char** arguments);

}  // namespace voussoir
