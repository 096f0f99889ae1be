#pragma once
// A page of the manual that is a text of its own: reports/<name>.md.
#include <string>
#include <vector>

#include "reports/case_page.hpp"

namespace voussoir::reports {

// A section with the anchor `anchor`, the text's own title its heading. Links to a case, ../cases/<case>/README.md, or
// to a scene of one point to their place in the manual; a picture is the figure of its name; one that was not drawn is
// said there, and in `missing`.
std::string text_page(const Folders& folders, const std::string& name, const std::string& anchor,
                      std::vector<std::string>& missing);

}  // namespace voussoir::reports
