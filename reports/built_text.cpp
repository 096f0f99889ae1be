#include "reports/built_text.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "reports/html.hpp"
#include "verification/verdict_file.hpp"

namespace voussoir::reports {

namespace fs = std::filesystem;

std::string built_text(const fs::path& file, int heading_shift, const std::string& without, const std::string& who,
                       std::vector<std::string>& missing) {
  const auto say_missing = [&](const std::string& text) {
    missing.push_back(who + ": " + text);
    return fmt::format("<p class=\"note\">{}</p>\n", escape(text));
  };
  if (!fs::exists(file)) return say_missing(without);
  const LinkRules rules{[](const std::string& target) -> std::optional<std::string> {
                          return "#" + slug(fs::path(target).parent_path().filename().string());
                        },
                        [&](const std::string& target, const std::string& caption) -> std::optional<std::string> {
                          const std::string stem = fs::path(target).stem().string();
                          try {
                            return drawn_figure({file.parent_path()}, stem, slug(stem), caption);
                          } catch (const std::runtime_error& problem) {
                            return say_missing(problem.what());
                          }
                        }};
  return markdown_to_html(verification::read_text(file), heading_shift, false, rules);
}

}  // namespace voussoir::reports
