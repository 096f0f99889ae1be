#include "reports/others_page.hpp"

#include <fmt/format.h>

#include "reports/html.hpp"
#include "verification/verdict_file.hpp"

namespace voussoir::reports {

namespace fs = std::filesystem;

std::string others_page(const Folders& folders, std::vector<std::string>& missing) {
  const fs::path folder = folders.source / "verification" / "others";
  const fs::path text = "verification/others/README.md";
  LinkRules rules = rules_of(folders, text, "other-engines", missing);
  rules.link = [&](const std::string& target) -> std::optional<std::string> {
    return target == "results.md" ? "#other-engines-results" : place_of(folders.anchors, text, target);
  };
  const auto show = [&](const char* file, int shift) {
    return markdown_to_html(verification::read_text(folder / file), shift, true, rules);
  };
  return fmt::format(
      "<section class=\"case\" id=\"other-engines\">\n<h2>Other engines</h2>\n{}<details id=\"other-engines-results\">"
      "<summary>All values</summary>\n<div class=\"scroll\">{}</div></details>\n</section>\n",
      show("README.md", 1), show("results.md", 2));
}

}  // namespace voussoir::reports
