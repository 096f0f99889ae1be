#include "reports/text_page.hpp"

#include <fmt/format.h>

#include "reports/html.hpp"
#include "verification/verdict_file.hpp"

namespace voussoir::reports {

namespace fs = std::filesystem;

std::string text_page(const Folders& folders, const std::string& name, const std::string& anchor,
                      std::vector<std::string>& missing) {
  const std::string text = verification::read_text(folders.source / "reports" / (name + ".md"));
  const LinkRules rules{[](const std::string& target) -> std::optional<std::string> {
                          const fs::path path(target);
                          if (path.parent_path().parent_path() != "../cases") return {};
                          const std::string of_case = slug(path.parent_path().filename().string());
                          if (path.filename() == "README.md") return "#" + of_case;
                          if (path.filename() == "NOTES.md") return fmt::format("#{}-notes", of_case);
                          return fmt::format("#{}-{}", of_case, slug(path.filename().string()));
                        },
                        [&](const std::string& target, const std::string& caption) -> std::optional<std::string> {
                          const fs::path figures = folders.build / "reports" / "figures";
                          const std::string stem = fs::path(target).stem().string();
                          if (!fs::exists(figures / (stem + ".svg"))) {
                            missing.push_back(fmt::format("{}: the figure {} was not drawn", name, target));
                            return fmt::format("<p class=\"note\">The figure {} was not drawn.</p>\n", escape(target));
                          }
                          return drawn_figure({figures}, stem, slug(stem), caption);
                        }};
  return fmt::format("<section class=\"case\" id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", anchor,
                     escape(markdown_title(text).value_or(name)), markdown_to_html(text, 1, true, rules));
}

}  // namespace voussoir::reports
