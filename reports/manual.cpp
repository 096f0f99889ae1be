// voussoir_manual: builds the manual: a folder of pages, one self-contained HTML file, and the text that is printed.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "reports/pages.hpp"

namespace {

namespace fs = std::filesystem;
using namespace voussoir::reports;
using namespace voussoir::verification;

// the common script of the viewers of all cases; empty if there are none
std::string viewer_script(const Folders& folders, std::vector<std::string>& missing) {
  const fs::path script = folders.build / "reports" / "views" / "script.html";
  if (fs::exists(script)) return read_text(script);
  missing.push_back("blocks that can be turned: reports/make_views.py has made none");
  return {};
}

// NAME.html, and beside it the folder NAME and NAME.print.html
void write(Sources& sources, const fs::path& out) {
  const auto from_file = [&](const char* name) { return read_text(sources.folders.source / "reports" / name); };
  const std::vector<BookPage> pages = all_pages(sources);
  const BookStyle style{sources.version, cover(sources), from_file("manual.css"), from_file("manual.js"),
                        viewer_script(sources.folders, sources.missing)};
  write_atomically(out, single_file(pages, style, false));
  write_atomically(fs::path(out).replace_extension(".print.html"), single_file(pages, style, true));
  write_pages(fs::path(out).replace_extension(), pages, style);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Builds the manual from the verdicts, figures and studies of a build."};
  std::vector<std::string> missing;
  Sources sources{{}, {}, {}, VOUSSOIR_VERSION, {}, missing};
  fs::path out;
  app.add_option("--source", sources.folders.source, "the repository")->required();
  app.add_option("--build", sources.folders.build, "the build folder, which contains reports/verdicts.json")
      ->required();
  app.add_option("--scene-keys", sources.keys,
                 "markdown list of all scene keys (default: reports/scene_keys.md in the build)");
  app.add_option("--book", sources.book, "list of chapters and pages (default: reports/book.toml of the repository)");
  app.add_option("--out", out,
                 "the manual in one file (default: reports/manual-VERSION.html in the build); its pages are in the "
                 "folder of that name");
  CLI11_PARSE(app, argc, argv);
  const fs::path reports = sources.folders.build / "reports";
  if (sources.keys.empty()) sources.keys = reports / "scene_keys.md";
  if (sources.book.empty()) sources.book = sources.folders.source / "reports" / "book.toml";
  if (out.empty()) out = reports / fmt::format("manual-{}.html", VOUSSOIR_VERSION);

  try {
    sources.verdicts = verdicts_from_json(nlohmann::json::parse(read_text(reports / "verdicts.json")));
    write(sources, out);
    for (const std::string& text : missing)
      fmt::print("missing: {}\n", text);
    fmt::print("manual: {} and {}\n", (fs::path(out).replace_extension() / "index.html").string(), out.string());
    return 0;
  } catch (const std::exception& problem) {
    fmt::print(stderr, "voussoir_manual: {}\n", problem.what());
    return 1;
  }
}
