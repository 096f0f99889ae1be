// `voussoir docs`.
#pragma once

#include "app/base/command.hpp"

namespace voussoir {

// every key a scene and a study may hold and every column of history.csv, as Markdown; or pages made of the parser: all
// commands have been added to `program` once it acts
void add_docs(CLI::App& program, Action& action);

}  // namespace voussoir
