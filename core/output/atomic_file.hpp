// Files appear whole or not at all: written under a temporary name beside the target, then renamed.
#pragma once

#include <filesystem>
#include <string_view>

#include "core/output/output_error.hpp"

namespace voussoir {

// replaces `path` by `content`; throws OutputError
void write_file(const std::filesystem::path& path, std::string_view content);

// makes the folder and its parents, and proves that a file can be created there; throws OutputError
void prepare_folder(const std::filesystem::path& folder);

}  // namespace voussoir
