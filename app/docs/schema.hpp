// `voussoir docs --schema`.
#pragma once

#include <string>

namespace voussoir {

// JSON Schema (draft 7) of scenes and studies: a file with `quantity` is a study. Editors that take one schema for
// each can point at its definitions "scene" and "study".
std::string files_schema();

}  // namespace voussoir
