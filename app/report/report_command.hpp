// `voussoir report`.
#pragma once

#include "app/base/command.hpp"

namespace voussoir {

// one page of a run, for a dossier: the answer, what fails, figures, the input in full
void add_report(CLI::App& program, Action& action);

}  // namespace voussoir
