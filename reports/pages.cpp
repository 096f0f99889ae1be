#include "reports/pages.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "reports/case_page.hpp"
#include "reports/html.hpp"
#include "reports/kernel_page.hpp"
#include "reports/key_page.hpp"
#include "reports/matrix_page.hpp"
#include "reports/others_page.hpp"
#include "reports/stiffness_page.hpp"
#include "reports/text_page.hpp"
#include "reports/trade_page.hpp"
#include "reports/verdict_tables.hpp"
#include "verification/history.hpp"

namespace voussoir::reports {
namespace {

namespace fs = std::filesystem;
using namespace verification;

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
      all_good(verdicts) ? "passed" : "failed", one_line(verdicts), sources.version, escape(verdicts.commit),
      commit_note(verdicts));
}

// values of earlier versions
std::string history(const Sources& sources) {
  const Verdicts& verdicts = sources.verdicts;
  std::string text =
      "<section class=\"case\" id=\"history\"><h2>History</h2>\n<p>" +
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

// what cases say of their limits, case by case
std::string limits_of_cases(const Sources& sources) {
  std::string text =
      "<p>The last section of each case's page. A limit was found by that case: the page has its numbers.</p>\n";
  for (const CaseStatus& status : sources.verdicts.cases) {
    const fs::path file = fs::path("cases") / status.name / "README.md";
    if (!fs::exists(sources.folders.source / file)) continue;
    const std::string readme = read_text(sources.folders.source / file);
    const std::size_t at = readme.find("\n## Limits\n");
    if (at == std::string::npos) continue;
    text += fmt::format("<h3><a href=\"#{}\">{}</a></h3>\n", slug(status.name), escape(status.name)) +
            markdown_to_html(readme.substr(at + std::string_view("\n## Limits\n").size()), 1, false,
                             rules_of(sources.folders, file, "limits-of-cases", sources.missing));
  }
  return section("limits-of-cases", "Limits, case by case", text);
}

// all checks of the cases of a group
std::string checks_of(const Sources& sources, const PageGroup& group) {
  return section("checks-" + slug(group.title), "Checks: " + escape(group.title),
                 tables_of(sources.verdicts, cases_of(group)));
}

std::string verdicts_page(const Sources& sources, const std::vector<PageGroup>& page_groups) {
  std::string text = "<p>Each case with its checks; the pages “Checks: …” list the rows of a group.</p>\n";
  for (const PageGroup& group : page_groups)
    if (const std::vector<std::string> cases = cases_of(group); !cases.empty())
      text += fmt::format("<h3>{}</h3>\n", escape(group.title)) + case_overview(sources.verdicts, cases);
  return section("verdicts", "Verdicts", text);
}

// the common room of a page on theory, or none
std::string room_of(const fs::path& text) {
  if (text.parent_path().parent_path() == "core") return text.parent_path().filename().string();
  return text.parent_path() == "reports/theory" ? text.stem().string() : std::string();
}

using Maker = std::function<std::string()>;
using ReadMatrix = std::function<const Matrix&()>;

// pages that are computed, by their names in the list
std::map<std::string, Maker> computed_pages(const Sources& sources, const std::vector<PageGroup>& page_groups,
                                            const ReadMatrix& matrix) {
  const Folders& folders = sources.folders;
  const Verdicts& verdicts = sources.verdicts;
  std::vector<std::string>& missing = sources.missing;
  const auto list = [&](std::size_t number, const char* id, const char* title) {
    return [&sources, number, id, title] {
      return list_page(sources.keys, number, id, title, "voussoir docs", sources.missing);
    };
  };
  std::map<std::string, Maker> makers{{"top", [&] { return front(sources); }},
                                      {"verdicts", [&] { return verdicts_page(sources, page_groups); }},
                                      {"all-checks", [&] { return checks_page(folders, missing); }},
                                      {"history", [&] { return history(sources); }},
                                      {"limits-of-cases", [&] { return limits_of_cases(sources); }},
                                      {"joint-stiffness", [&] { return stiffness_page(folders, verdicts, missing); }},
                                      {"equations", [&] { return equations_page(matrix(), verdicts); }},
                                      {"thesis-cases", [&] { return thesis_page(matrix()); }},
                                      {"promises", [&] { return promises_page(matrix()); }},
                                      {"grounds", [&] { return grounds_page(matrix(), verdicts); }},
                                      {"what-accuracy-costs", [&] { return trade_page(folders, missing); }},
                                      {"contact-kernel", [&] { return kernel_page(folders, missing); }},
                                      {"other-engines", [&] { return others_page(folders, missing); }},
                                      {"scene-keys", list(0, "scene-keys", "Scene keys")},
                                      {"columns", list(1, "columns", "Columns of history.csv")},
                                      {"study-keys", list(2, "study-keys", "Study keys")},
                                      {"public-headers", [&] {
                                         return list_page(folders.build / "reports" / "library_headers.md", 0,
                                                          "public-headers", "Public headers", "library/header_pages.py",
                                                          missing);
                                       }}};
  for (const PageGroup& group : page_groups)
    if (!cases_of(group).empty()) makers["checks/" + group.title] = [&] { return checks_of(sources, group); };
  return makers;
}

// the section of one entry of the list; none for a case that this build does not have
std::optional<std::string> section_of(const Sources& sources, const std::string& page, const ReadMatrix& matrix,
                                      const std::map<std::string, Maker>& makers) {
  if (page.starts_with("cases/")) {
    for (const CaseStatus& status : sources.verdicts.cases)
      if ("cases/" + status.name == page) return case_page(sources.folders, sources.verdicts, status, sources.missing);
    return std::nullopt;
  }
  if (const auto made = makers.find(page); made != makers.end()) return made->second();
  if (!page.ends_with(".md")) throw std::runtime_error(fmt::format("book.toml: no page is named \"{}\"", page));
  std::string text = text_page(sources.folders, page, anchor_of_text(page), sources.missing);
  if (const std::string room = room_of(page); !room.empty())
    text.insert(text.rfind("</section>"), room_equations(matrix(), room));
  return text;
}

// id and title of a section, which has them once: in its tag and in its first heading
BookPage page_of(const PageGroup& group, const std::string& section) {
  const std::size_t id = section.find("id=\"") + std::string_view("id=\"").size(), heading = section.find("<h");
  const std::size_t title = section.find('>', heading) + 1;
  return {group.chapter,
          group.title,
          section.substr(id, section.find('"', id) - id),
          section.substr(title, section.find("</h", title) - title),
          section,
          group.printed,
          group.in_file};
}

void expect_all_cases(const Verdicts& verdicts, const std::vector<PageGroup>& page_groups) {
  for (const CaseStatus& status : verdicts.cases)
    if (std::none_of(page_groups.begin(), page_groups.end(), [&](const PageGroup& group) {
          const std::vector<std::string> cases = cases_of(group);
          return std::find(cases.begin(), cases.end(), status.name) != cases.end();
        }))
      throw std::runtime_error(
          fmt::format("book.toml: no group has the case {}; add \"cases/{}\" to one", status.name, status.name));
}

}  // namespace

Anchors anchors_of(const std::vector<PageGroup>& page_groups) {
  Anchors anchors{{"README.md", "top"}, {"docs/README.md", "top"}, {"cases/README.md", "verdicts"}};
  for (const PageGroup& group : page_groups)
    for (const std::string& page : group.pages)
      if (page.ends_with(".md")) anchors[page] = anchor_of_text(page);
  return anchors;
}

std::string cover(const Sources& sources) {
  const Verdicts& verdicts = sources.verdicts;
  const auto today = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
  return fmt::format(
      "<header class=\"cover\"><h1>Voussoir {}</h1>\n<p>Manual: guide, theory, verification, reference</p>\n<p>Commit "
      "<code>{}</code>, printed "
      "{:%Y-%m-%d}</p>\n<p>{}</p></header>\n",
      sources.version, escape(verdicts.commit), fmt::gmtime(std::chrono::system_clock::to_time_t(today)),
      one_line(verdicts));
}

std::vector<BookPage> all_pages(Sources& sources) {
  const std::vector<PageGroup> page_groups = read_book(sources.book);
  sources.folders.anchors = anchors_of(page_groups);
  expect_all_cases(sources.verdicts, page_groups);
  std::optional<Matrix> read;  // only if a page needs it: it takes all sources of the repository
  const ReadMatrix matrix = [&]() -> const Matrix& {
    if (!read) read = read_matrix(sources.folders.source);
    return *read;
  };
  const std::map<std::string, Maker> makers = computed_pages(sources, page_groups, matrix);
  std::vector<BookPage> pages;
  for (const PageGroup& group : page_groups)
    for (const std::string& name : group.pages)
      if (const auto section = section_of(sources, name, matrix, makers)) pages.push_back(page_of(group, *section));
  for (const std::string& lost : connect(pages))
    sources.missing.push_back(lost);
  return pages;
}

}  // namespace voussoir::reports
