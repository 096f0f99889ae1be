#pragma once
// A page of the manual that is a text of the repository: reports/<name>.md, docs/<name>.md, core/<room>/README.md.
#include <string>
#include <vector>

#include "reports/links.hpp"

namespace voussoir::reports {

// A section with the anchor `anchor`, the text's own title its heading. `file` is a path in the repository. Links to
// texts and scenes that the manual shows point to their places in it; a picture that was not drawn is named there, and
// in `missing`.
std::string text_page(const Folders& folders, const std::filesystem::path& file, const std::string& anchor,
                      std::vector<std::string>& missing);

}  // namespace voussoir::reports
