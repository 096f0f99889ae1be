#include "reports/trade_page.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "reports/html.hpp"
#include "verification/verdict_file.hpp"

namespace voussoir::reports {

namespace fs = std::filesystem;

std::string trade_page(const Folders& folders, std::vector<std::string>& missing) {
  const auto say_missing = [&](const std::string& text) {
    missing.push_back("what accuracy costs: " + text);
    return fmt::format("<p class=\"note\">{}</p>\n", escape(text));
  };
  const fs::path studies = folders.build / "reports" / "studies";
  const LinkRules rules{[&](const std::string& target, const std::string& caption) -> std::optional<std::string> {
                          const std::string stem = fs::path(target).stem().string();
                          try {
                            return drawn_figure({studies}, stem, slug(stem), caption);
                          } catch (const std::runtime_error& problem) {
                            return say_missing(problem.what());
                          }
                        },
                        // a case's page
                        [](const std::string& target) -> std::optional<std::string> {
                          return "#" + slug(fs::path(target).parent_path().filename().string());
                        }};
  std::string text = "<section class=\"case\" id=\"what-accuracy-costs\">\n<h2>What accuracy costs</h2>\n";
  if (fs::exists(studies / "trade.md"))
    text += apply_links(markdown_to_html(verification::read_text(studies / "trade.md"), 0, false), rules);
  else
    text += say_missing("No study was compared: `make reports` runs them.");
  return text + "</section>\n";
}

}  // namespace voussoir::reports
