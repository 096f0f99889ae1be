// voussoir_manual: builds the verification manual, a single self-contained HTML file.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "reports/case_page.hpp"
#include "reports/html.hpp"
#include "reports/kernel_page.hpp"
#include "reports/matrix_page.hpp"
#include "reports/others_page.hpp"
#include "reports/text_page.hpp"
#include "reports/trade_page.hpp"
#include "reports/verdict_tables.hpp"
#include "verification/history.hpp"

namespace {

namespace fs = std::filesystem;
using namespace voussoir::reports;
using namespace voussoir::verification;

// common inputs of all parts of the manual
struct Sources {
  Folders folders;
  fs::path keys;  // markdown list of all scene keys
  Verdicts verdicts;
  std::vector<std::string>& missing;  // parts that could not be shown, one sentence each
};

// A part of the manual: its section, whose id is `id`, and its line in the list of contents.
struct Part {
  std::string group, id, title, html;
};

// commits of the rows that differ from the build's: results of another state of the source
std::string commit_note(const Verdicts& verdicts) {
  for (const Row& row : verdicts.rows)
    if (row.commit != verdicts.commit)
      return fmt::format("<p class=\"note\">Some results are older than this commit: {} is of {}.</p>\n",
                         escape(row.case_name), escape(row.commit));
  return {};
}

std::string front(const Sources& sources) {
  const Verdicts& verdicts = sources.verdicts;
  return fmt::format(
      "<section id=\"top\">\n{}<p class=\"state {}\"><b>{}.</b> Version {}, commit "
      "<code>{}</code>.</p>\n{}</section>\n",
      markdown_to_html(read_text(sources.folders.source / "reports" / "front.md")),
      all_good(verdicts) ? "passed" : "failed", one_line(verdicts), VOUSSOIR_VERSION, escape(verdicts.commit),
      commit_note(verdicts));
}

// a list in markdown that `maker` has written
std::string list_page(const Sources& sources, const fs::path& list, const char* id, const char* title,
                      const char* maker) {
  std::string text = fmt::format("<section id=\"{}\"><h2>{}</h2>\n", id, title);
  if (fs::exists(list) && fs::file_size(list) > 0) {
    const LinkRules without_pictures{
        {}, [](const std::string&, const std::string&) -> std::optional<std::string> { return {}; }};
    return text + markdown_to_html(read_text(list), 1, true, without_pictures) + "</section>\n";
  }
  sources.missing.push_back(fmt::format("{}: {} did not list them", title, maker));
  return text + fmt::format(
                    "<p class=\"note\">The list is missing: <code>{}</code> was not available when this manual was "
                    "built.</p></section>\n",
                    maker);
}

void add_cases(const Sources& sources, CaseState state, bool wanted, const std::string& group,
               std::vector<Part>& parts) {
  for (const CaseStatus& status : sources.verdicts.cases)
    if ((status.state == state) == wanted)
      parts.push_back({group, slug(status.name), status.name,
                       case_page(sources.folders, sources.verdicts, status, sources.missing)});
}

void add_matrix(const Sources& sources, std::vector<Part>& parts) {
  try {
    const Matrix matrix = read_matrix(sources.folders.source);
    parts.push_back({"By tests", "equations", "Equations", equations_page(matrix, sources.verdicts)});
    parts.push_back({"By tests", "thesis-cases", "The thesis's cases", thesis_page(matrix)});
    parts.push_back({"By tests", "promises", "Promises", promises_page(matrix)});
    parts.push_back({"By tests", "grounds", "Basis of the checks", grounds_page(matrix, sources.verdicts)});
  } catch (const std::exception& problem) {
    sources.missing.push_back(fmt::format("equations by tests: {}", problem.what()));
    parts.push_back({"By tests", "equations", "Equations",
                     fmt::format("<section class=\"case\" id=\"equations\">\n<h2>Equations by tests</h2>\n<p "
                                 "class=\"note\">The lists cannot be read: {}</p></section>\n",
                                 escape(problem.what()))});
  }
}

// values of earlier versions
std::string history(const Sources& sources) {
  const Verdicts& verdicts = sources.verdicts;
  std::string text =
      "<section id=\"history\"><h2>History</h2>\n<p>" +
      (verdicts.compared_with.empty()
           ? "No earlier version is kept, so nothing is compared."
           : fmt::format("Every value and every count of contact evaluations is compared with version {}: "
                         "{} of {} rows moved. A value has moved when it differs by more than rounding, a "
                         "count when it differs at all; the changelog gives the reason.",
                         escape(verdicts.compared_with), verdicts.moved.size(), verdicts.rows.size())) +
      "</p>\n";
  std::string moves;
  for (const Moved& moved : verdicts.moved)
    moves += "<li>" + escape(describe(moved, verdicts.compared_with)) + "</li>\n";
  if (!moves.empty()) text += "<ul>\n" + moves + "</ul>\n";
  const fs::path figures = sources.folders.build / "reports" / "figures";
  if (fs::exists(figures / "history.svg"))
    text += drawn_figure({figures}, "history", "history",
                         "Each case's values and contact evaluations, version by version, against the present ones.");
  else
    sources.missing.push_back("history: its figure was not drawn");
  return text + "</section>\n";
}

// the common script of the viewers of all cases; empty if there are none
std::string viewer_script(const Sources& sources) {
  const fs::path script = sources.folders.build / "reports" / "views" / "script.html";
  if (fs::exists(script)) return read_text(script);
  sources.missing.push_back("blocks that can be turned: reports/make_views.py has made none");
  return {};
}

// in the order of the manual
std::vector<Part> all_parts(const Sources& sources) {
  const Folders& folders = sources.folders;
  const Verdicts& verdicts = sources.verdicts;
  std::vector<Part> parts{{"", "top", "About this manual", front(sources)},
                          {"", "verdicts", "Verdicts",
                           "<section id=\"verdicts\">\n<h2>Verdicts</h2>\n" + case_overview(verdicts) +
                               all_tables(verdicts) + "</section>\n"},
                          {"", "all-checks", "All checks at a glance", checks_page(folders, sources.missing)},
                          {"", "history", "History", history(sources)}};
  add_cases(sources, CaseState::not_modelled, false, "Cases", parts);
  add_cases(sources, CaseState::not_modelled, true, "Not yet modelled", parts);
  add_matrix(sources, parts);
  parts.push_back({"Speed", "what-accuracy-costs", "Cost of accuracy", trade_page(folders, sources.missing)});
  parts.push_back({"Speed", "what-a-slope-costs", "Cost on a slope",
                   text_page(folders, "slope_cost", "what-a-slope-costs", sources.missing)});
  parts.push_back({"Speed", "what-equilibrium-costs", "Cost of equilibrium",
                   text_page(folders, "rest_cost", "what-equilibrium-costs", sources.missing)});
  parts.push_back({"Speed", "contact-kernel", "The contact kernel", kernel_page(folders, sources.missing)});
  parts.push_back({"Speed", "other-engines", "Other engines", others_page(folders)});
  parts.push_back({"Reference", "what-water-means", "Water in the model",
                   text_page(folders, "water", "what-water-means", sources.missing)});
  parts.push_back({"Reference", "scene-keys", "Scene keys",
                   list_page(sources, sources.keys, "scene-keys", "Scene keys", "voussoir docs")});
  parts.push_back({"Reference", "public-headers", "Public headers",
                   list_page(sources, folders.build / "reports" / "library_headers.md", "public-headers",
                             "Public headers", "library/header_pages.py")});
  return parts;
}

// the list of parts beside the text, with a box to find cases, keys and equations, which the script fills
std::string navigation(const std::vector<Part>& parts) {
  std::string text = fmt::format(
      "<nav><p class=\"name\"><a href=\"#top\">Voussoir</a> <span class=\"quiet\">{}</span></p>\n", VOUSSOIR_VERSION);
  text +=
      "<div id=\"finder\" hidden><input type=\"search\" id=\"find\" placeholder=\"Find a case, key or equation\" "
      "aria-label=\"Find a case, key or equation\" autocomplete=\"off\"><ul id=\"found\"></ul></div>\n";
  for (auto part = parts.begin(); part != parts.end();) {
    const std::string group = part->group;
    text += (group.empty() ? "" : fmt::format("<p>{}</p>", escape(group))) + "<ul>\n";
    for (; part != parts.end() && part->group == group; ++part)
      text += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", part->id, escape(part->title));
    text += "</ul>\n";
  }
  return text + "</nav>\n";
}

// the title page of a printed manual
std::string cover(const Verdicts& verdicts) {
  const auto today = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
  return fmt::format(
      "<header class=\"cover\"><h1>Voussoir {}</h1>\n<p>Verification manual</p>\n<p>Commit <code>{}</code>, printed "
      "{:%Y-%m-%d}</p>\n<p>{}</p></header>\n",
      VOUSSOIR_VERSION, escape(verdicts.commit), fmt::gmtime(std::chrono::system_clock::to_time_t(today)),
      one_line(verdicts));
}

std::string manual(const Sources& sources) {
  const std::vector<Part> parts = all_parts(sources);
  const auto from_file = [&](const char* name) { return read_text(sources.folders.source / "reports" / name); };
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<title>Voussoir {}: verification manual</title>\n<style>\n{}</style></head>\n<body>\n{}{}<main>\n",
      VOUSSOIR_VERSION, from_file("manual.css"), cover(sources.verdicts), navigation(parts));
  for (const Part& part : parts)
    text += part.html;
  return text + "</main>\n" + viewer_script(sources) + "<script>\n" + from_file("manual.js") +
         "</script>\n</body></html>\n";
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Builds the verification manual from the verdicts, figures and studies of a build."};
  std::vector<std::string> missing;
  Sources sources{{}, {}, {}, missing};
  fs::path out;
  app.add_option("--source", sources.folders.source, "the repository")->required();
  app.add_option("--build", sources.folders.build, "the build folder, which contains reports/verdicts.json")
      ->required();
  app.add_option("--scene-keys", sources.keys,
                 "markdown list of all scene keys (default: reports/scene_keys.md in the build)");
  app.add_option("--out", out, "the manual (default: reports/manual-VERSION.html in the build)");
  CLI11_PARSE(app, argc, argv);
  const fs::path reports = sources.folders.build / "reports";
  if (sources.keys.empty()) sources.keys = reports / "scene_keys.md";
  if (out.empty()) out = reports / fmt::format("manual-{}.html", VOUSSOIR_VERSION);

  try {
    sources.verdicts = verdicts_from_json(nlohmann::json::parse(read_text(reports / "verdicts.json")));
    write_atomically(out, manual(sources));
    for (const std::string& text : missing)
      fmt::print("missing: {}\n", text);
    fmt::print("manual: {}\n", out.string());
    return 0;
  } catch (const std::exception& problem) {
    fmt::print(stderr, "voussoir_manual: {}\n", problem.what());
    return 1;
  }
}
