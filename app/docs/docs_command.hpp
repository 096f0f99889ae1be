// `voussoir docs`.
#pragma once

#include "app/base/command.hpp"

namespace voussoir {

// every key of scenes and studies and every column of history.csv, as Markdown; or pages made from the parser: all
// commands must have been added to `program` before it runs
void add_docs(CLI::App& program, Action& action);

}  // namespace voussoir
