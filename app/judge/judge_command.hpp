// `voussoir judge`.
#pragma once

#include "app/base/command.hpp"

namespace voussoir {

// judges the answers of codes to the problem files: judgement.md, .html, .csv and error_against_cost.svg
void add_judge(CLI::App& program, Action& action);

}  // namespace voussoir
