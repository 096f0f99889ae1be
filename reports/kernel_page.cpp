#include "reports/kernel_page.hpp"

#include <fmt/format.h>

#include "reports/html.hpp"
#include "verification/verdict_file.hpp"

namespace voussoir::reports {

namespace fs = std::filesystem;
using verification::read_text;

std::string kernel_page(const Folders& folders, std::vector<std::string>& missing) {
  const auto say_missing = [&](const std::string& text) {
    missing.push_back("contact kernel: " + text);
    return fmt::format("<p class=\"note\">{}</p>\n", escape(text));
  };
  const LinkRules rules = rules_of(folders, "reports/contact_kernel.md", "contact-kernel", missing);
  const auto show = [&](const fs::path& file, int heading_shift) {
    if (!fs::exists(file))
      return say_missing(fmt::format("{} was not made: the kernel was not timed.", file.filename().string()));
    return markdown_to_html(read_text(file), heading_shift, true, rules);
  };

  const fs::path measured = folders.build / "reports" / "benchmarks";
  std::string text = "<section class=\"case\" id=\"contact-kernel\">\n<h2>The contact kernel: speed</h2>\n";
  text += show(folders.source / "reports" / "contact_kernel.md", 1);
  text += "<h3>Measured</h3>\n" + show(measured / "contact_summary.md", 1);
  text += "<details><summary>All times, state by state</summary>\n<div class=\"scroll\">" +
          show(measured / "contact_times.md", 1) + "</div></details>\n";
  return text + "</section>\n";
}

}  // namespace voussoir::reports
