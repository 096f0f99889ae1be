// reference.json: the references of a problem, from the verdict rows that the cases' tests wrote.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "verification/problems/problem.hpp"

namespace voussoir::problems {

// `verdicts` is the folder of verdict rows of a build. Expected values are taken, of a reported row its value. Throws
// std::runtime_error, which names case, row and repair, if a row is missing, has another unit than the question, or is
// not finite.
nlohmann::ordered_json reference_json(const Problem& problem, const std::filesystem::path& verdicts);

}  // namespace voussoir::problems
