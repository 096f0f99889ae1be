// The files of a problem that people read and fill in.
#pragma once

#include <string>

#include "verification/problems/problem.hpp"

namespace voussoir::problems {

// The task: what to model, what is given, what is asked and how it is measured, the protocol of a search
std::string task_text(const Problem& problem);

// answer.csv with empty values, and how to fill it in as comments
std::string answer_text(const Problem& problem);

}  // namespace voussoir::problems
