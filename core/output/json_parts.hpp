// Parts of JSON files, for the writers of several of them. Not installed: users of the library need no JSON library.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace voussoir {

struct Origin;
struct RecordRow;
struct AccuracyRound;

nlohmann::ordered_json origins_json(const std::vector<Origin>& origins);
// throws nlohmann::json::exception
std::vector<Origin> origins_of(const nlohmann::json& json);

// `records` of results.json: SI units in the keys
nlohmann::ordered_json records_json(const std::vector<RecordRow>& rows);

nlohmann::ordered_json rounds_json(const std::vector<AccuracyRound>& rounds);

}  // namespace voussoir
