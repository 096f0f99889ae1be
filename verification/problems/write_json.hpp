// blocks.json and its schema's name, of a problem.
#pragma once

#include <nlohmann/json.hpp>

#include "verification/problems/problem.hpp"

namespace voussoir::problems {

// everything that a program needs to pose the problem; every number reads back to the same double
nlohmann::ordered_json blocks_json(const Problem& problem);

}  // namespace voussoir::problems
