// The part of JSON Schema 2020-12 that blocks.schema.json uses.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace voussoir::problems {

// Where a document differs from a schema, a line each; empty: it is valid. Knows type, properties, required,
// additionalProperties, items, minItems, maxItems, minLength, enum, const, minimum, exclusiveMinimum, exclusiveMaximum,
// oneOf, pattern and $ref into $defs; throws std::invalid_argument at any other keyword, so that none is passed over.
std::vector<std::string> schema_violations(const nlohmann::json& document, const nlohmann::json& schema);

}  // namespace voussoir::problems
