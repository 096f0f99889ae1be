#include "reports/text_page.hpp"

#include "verification/verdict_file.hpp"

namespace voussoir::reports {

std::string text_page(const Folders& folders, const std::filesystem::path& file, const std::string& anchor,
                      std::vector<std::string>& missing) {
  const std::string text = verification::read_text(folders.source / file);
  return section(anchor, escape(markdown_title(text).value_or(file.stem().string())),
                 markdown_to_html(text, 1, true, rules_of(folders, file, anchor, missing)));
}

}  // namespace voussoir::reports
