// `voussoir judge`.
#pragma once

#include "app/base/command.hpp"

namespace voussoir {

// judges the answers of codes to the problem files: a table as Markdown, HTML and CSV, and a figure of errors against cost
void add_judge(CLI::App& program, Action& action);

}  // namespace voussoir
