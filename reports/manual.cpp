// voussoir_manual: builds the verification manual, one HTML file that needs nothing else to be read.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "reports/case_page.hpp"
#include "reports/html.hpp"
#include "reports/kernel_page.hpp"
#include "reports/text_page.hpp"
#include "reports/trade_page.hpp"
#include "reports/verdict_tables.hpp"
#include "verification/verdicts.hpp"

namespace {

namespace fs = std::filesystem;
using namespace voussoir::reports;
using namespace voussoir::verification;

std::string navigation(const Verdicts& verdicts) {
  std::string cases, open;
  for (const CaseStatus& status : verdicts.cases) {
    const std::string line = fmt::format("<li><a href=\"#{}\">{}</a></li>\n", slug(status.name), escape(status.name));
    (status.state == CaseState::not_modelled ? open : cases) += line;
  }
  std::string text =
      "<nav><p class=\"name\"><a href=\"#top\">Voussoir</a></p><ul>\n"
      "<li><a href=\"#top\">What this is</a></li>\n<li><a href=\"#verdicts\">Verdicts</a></li>\n</ul>\n";
  text += "<p>Cases</p><ul>\n" + cases + "</ul>\n";
  if (!open.empty()) text += "<p>Not yet modelled</p><ul>\n" + open + "</ul>\n";
  return text +
         "<p>Speed</p><ul>\n<li><a href=\"#what-accuracy-costs\">What accuracy costs</a></li>\n"
         "<li><a href=\"#what-a-slope-costs\">What it costs on a slope</a></li>\n"
         "<li><a href=\"#contact-kernel\">The contact kernel</a></li>\n</ul>\n<p>Reference</p><ul>\n"
         "<li><a href=\"#what-water-means\">What water means here</a></li>\n<li><a "
         "href=\"#scene-keys\">Scene keys</a></li>\n</ul></nav>\n";
}

// commits of the rows that differ from the build's: results of another state of the source
std::string commit_note(const Verdicts& verdicts) {
  for (const Row& row : verdicts.rows)
    if (row.commit != verdicts.commit)
      return fmt::format("<p class=\"note\">Some results are older than this commit: {} is of {}.</p>\n",
                         escape(row.case_name), escape(row.commit));
  return {};
}

std::string scene_keys(const fs::path& file, std::vector<std::string>& missing) {
  std::string text = "<section id=\"scene-keys\"><h2>Scene keys</h2>\n";
  if (fs::exists(file) && fs::file_size(file) > 0) {
    const LinkRules keep{[](const std::string&, const std::string&) -> std::optional<std::string> { return ""; },
                         [](const std::string& target) -> std::optional<std::string> { return target; }};
    return text + apply_links(markdown_to_html(read_text(file), 1, true), keep) + "</section>\n";
  }
  missing.push_back("scene keys: the program voussoir did not list them");
  return text +
         "<p class=\"note\">The list is missing: the program <code>voussoir docs</code> was not available when "
         "this manual was built.</p></section>\n";
}

std::string manual(const Folders& folders, const Verdicts& verdicts, const fs::path& keys,
                   std::vector<std::string>& missing) {
  const bool good = all_good(verdicts);
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>Voussoir: verification manual</title>\n<style>\n{}</style></head>\n<body>\n{}<main>\n",
      read_text(folders.source / "reports" / "manual.css"), navigation(verdicts));

  text += fmt::format("<section id=\"top\">\n{}", markdown_to_html(read_text(folders.source / "reports" / "front.md")));
  text += fmt::format("<p class=\"state {}\"><b>{}.</b> Commit <code>{}</code>.</p>\n{}</section>\n",
                      good ? "passed" : "failed", one_line(verdicts), escape(verdicts.commit), commit_note(verdicts));
  text += "<section id=\"verdicts\">\n<h2>Verdicts</h2>\n" + case_overview(verdicts) + all_tables(verdicts) +
          "</section>\n";
  for (const CaseStatus& status : verdicts.cases)
    text += case_page(folders, verdicts, status, missing);
  return text + trade_page(folders, missing) + text_page(folders, "slope_cost", "what-a-slope-costs") +
         kernel_page(folders, missing) + text_page(folders, "water", "what-water-means") + scene_keys(keys, missing) +
         "</main>\n</body></html>\n";
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Builds the verification manual from the verdicts, figures and studies of a build."};
  Folders folders;
  fs::path keys, out;
  app.add_option("--source", folders.source, "the repository")->required();
  app.add_option("--build", folders.build, "the build folder, in which reports/verdicts.json lies")->required();
  app.add_option("--scene-keys", keys, "markdown list of all scene keys (default: reports/scene_keys.md in the build)");
  app.add_option("--out", out, "the manual (default: reports/index.html in the build)");
  CLI11_PARSE(app, argc, argv);
  if (keys.empty()) keys = folders.build / "reports" / "scene_keys.md";
  if (out.empty()) out = folders.build / "reports" / "index.html";

  try {
    const fs::path file = folders.build / "reports" / "verdicts.json";
    const Verdicts verdicts = verdicts_from_json(nlohmann::json::parse(read_text(file)));
    std::vector<std::string> missing;
    write_atomically(out, manual(folders, verdicts, keys, missing));
    for (const std::string& text : missing)
      fmt::print("missing: {}\n", text);
    fmt::print("manual: {}\n", out.string());
    return 0;
  } catch (const std::exception& problem) {
    fmt::print(stderr, "voussoir_manual: {}\n", problem.what());
    return 1;
  }
}
