#pragma once
// A text that the build wrote, with the figures beside it.
#include <filesystem>
#include <string>
#include <vector>

namespace voussoir::reports {

// As HTML, its headings moved down by `heading_shift`. Links point to cases' pages; figures that were not drawn, and
// the file if it does not exist (`without` states the remedy), are named in the text and in `missing`, after `who`.
std::string built_text(const std::filesystem::path& file, int heading_shift, const std::string& without,
                       const std::string& who, std::vector<std::string>& missing);

}  // namespace voussoir::reports
