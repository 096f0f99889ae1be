// `voussoir docs`.
#pragma once

#include "app/base/exit_codes.hpp"

namespace voussoir {

// every key a scene and a study may hold and every column of history.csv, as Markdown, on stdout
ExitCode docs_command();

}  // namespace voussoir
