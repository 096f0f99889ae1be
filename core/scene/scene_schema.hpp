// The key table as JSON Schema, by which editors complete and check scenes.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace voussoir {

// Definitions (draft 7) of all tables of a scene; the whole file is "scene". A scene with `base` states only
// differences, so that for it required keys and conditions between keys are not asked. The program refuses more:
// vectors of another dimension, names that occur twice or that nothing has, rules between several tables.
nlohmann::ordered_json scene_definitions();

}  // namespace voussoir
