#include "reports/others_page.hpp"

#include <fmt/format.h>

#include "reports/html.hpp"
#include "verification/verdict_file.hpp"

namespace voussoir::reports {

namespace fs = std::filesystem;

std::string others_page(const Folders& folders) {
  const fs::path folder = folders.source / "verification" / "others";
  const LinkRules rules{[](const std::string& target) -> std::optional<std::string> {
                          if (target == "results.md") return "#other-engines-results";
                          return std::nullopt;
                        },
                        [&](const std::string& target, const std::string& caption) -> std::optional<std::string> {
                          const std::string stem = fs::path(target).stem().string();
                          return drawn_figure({folder}, stem, slug(stem), caption);
                        }};
  const auto show = [&](const char* file, int shift) {
    return markdown_to_html(verification::read_text(folder / file), shift, true, rules);
  };
  return fmt::format(
      "<section class=\"case\" id=\"other-engines\">\n<h2>Other engines</h2>\n{}<details id=\"other-engines-results\">"
      "<summary>All values</summary>\n<div class=\"scroll\">{}</div></details>\n</section>\n",
      show("README.md", 1), show("results.md", 2));
}

}  // namespace voussoir::reports
