#include "reports/case_page.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <initializer_list>
#include <set>
#include <sstream>
#include <stdexcept>

#include "reports/html.hpp"
#include "reports/parameters.hpp"
#include "reports/verdict_tables.hpp"

namespace voussoir::reports {
namespace {

namespace fs = std::filesystem;
using namespace verification;

std::vector<fs::path> files_with(const fs::path& folder, const std::string& extension) {
  std::vector<fs::path> files;
  if (fs::is_directory(folder))
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == extension) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::string note(const std::string& text) {
  return fmt::format("<p class=\"note\">{}</p>\n", escape(text));
}

// the parts of one page, and the figures that it has already shown
struct Page {
  const Folders& folders;
  std::string name;
  std::vector<std::string>& missing;
  std::set<std::string> shown = {};

  fs::path case_folder() const { return folders.source / "cases" / name; }
  fs::path study_folder() const { return folders.build / "reports" / "studies" / name; }

  std::string say_missing(const std::string& text) {
    missing.push_back(fmt::format("{}: {}", name, text));
    return note(text);
  }

  // a figure is sought among the case's and the study's; its caption is HTML already
  std::string show_figure(const std::string& stem, const std::string& caption) {
    shown.insert(stem);
    try {
      return picture_of(folders, fs::path("cases") / name / "README.md", stem, caption, name, {study_folder()});
    } catch (const std::runtime_error& problem) {
      return say_missing(problem.what());
    }
  }

  std::string render(const std::string& markdown, int heading_shift, bool leave_out_title) {
    return markdown_to_html(
        markdown, heading_shift, leave_out_title,
        {[this](const std::string& target) {
           return place_of(folders.anchors, fs::path("cases") / name / "README.md", target);
         },
         [this](const std::string& target, const std::string& caption) -> std::optional<std::string> {
           return show_figure(fs::path(target).stem().string(), caption);
         }});
  }
};

// a text up to its first heading of the second level, and from each of them to the next
std::vector<std::string> sections_of(const std::string& markdown) {
  std::vector<std::string> sections(1);
  bool fenced = false;
  std::istringstream lines(markdown);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) fenced = !fenced;
    if (!fenced && line.starts_with("## ")) sections.emplace_back();
    sections.back() += line + "\n";
  }
  return sections;
}

// sections of the README.md: those with these titles, in this order, or all others
std::string readme_sections(Page& page, const std::vector<std::string>& sections,
                            std::initializer_list<std::string_view> titles, bool all_others = false) {
  std::string text;
  const auto is = [](const std::string& section, std::string_view title) {
    return section.starts_with(fmt::format("## {}\n", title));
  };
  for (std::size_t k = 1; all_others && k < sections.size(); ++k)
    if (std::none_of(titles.begin(), titles.end(), [&](std::string_view title) { return is(sections[k], title); }))
      text += sections[k];
  for (const std::string_view title : titles)
    for (std::size_t k = 1; !all_others && k < sections.size(); ++k)
      if (is(sections[k], title)) text += sections[k];
  return page.render(text, 1, false);
}

// of the sketch and of the parameters: scene.toml, or the one that views.toml names
std::string drawn_scene(const Page& page) {
  const fs::path views = page.folders.source / "reports" / "views.toml";
  const std::string usual = "scene.toml";
  return fs::exists(views) ? toml::parse_file(views.string())["drawn"][page.name].value_or(usual) : usual;
}

std::string scene_files(const Page& page, const std::string& drawn) {
  std::string text;
  for (const fs::path& file : files_with(page.case_folder(), ".toml")) {
    const std::string name = file.filename().string();
    text +=
        fmt::format("<details id=\"{}-{}\"{}><summary>{}</summary><pre><code>{}</code></pre></details>\n",
                    slug(page.name), slug(name), name == drawn ? " open" : "", escape(name), escape(read_text(file)));
  }
  return text.empty() ? "" : "<h3>Scene</h3>\n" + text;
}

// measurements, trials and abandoned rules: folded until a reader opens them
std::string notes(Page& page) {
  const fs::path file = page.case_folder() / "NOTES.md";
  if (!fs::exists(file)) return "";
  return fmt::format("<h3 id=\"{}-notes\">Notes</h3>\n<details class=\"notes\"><summary>{}</summary>\n{}</details>\n",
                     slug(page.name), escape(markdown_title(read_text(file)).value_or("Notes")),
                     page.render(read_text(file), 2, true));
}

// the interactive view of the blocks, written by make_views.py
std::string blocks(const Page& page) {
  const fs::path figures = page.folders.build / "reports" / "views" / (page.name + ".html");
  return fs::exists(figures) ? fmt::format("<h3 id=\"{}-blocks\">Blocks</h3>\n{}", slug(page.name), read_text(figures))
                             : "";
}

// the dimensioned sketch of the scene, written by make_sketches.py
std::string sketch(const Page& page, const std::string& scene) {
  const fs::path folder = page.folders.build / "reports" / "sketches", drawing = folder / (page.name + ".svg");
  if (!fs::exists(drawing)) return {};
  const bool bolts = read_text(drawing).find("class=\"sketch-bolt\"") != std::string::npos;
  return drawn_figure({folder}, page.name, slug("sketch-" + page.name),
                      fmt::format("The blocks of <code>{}</code> as sliced; those that are free in orange{}.", scene,
                                  bolts ? ", bolts in blue" : ""));
}

}  // namespace

std::string case_title(const Folders& folders, const std::string& case_name) {
  const fs::path readme = folders.source / "cases" / case_name / "README.md";
  if (!fs::exists(readme)) return case_name;
  return markdown_title(read_text(readme)).value_or(case_name);
}

std::string case_page(const Folders& folders, const Verdicts& verdicts, const CaseStatus& status,
                      std::vector<std::string>& missing) {
  Page page{folders, status.name, missing};
  const std::string id = slug(status.name);
  std::string text =
      fmt::format("<section class=\"case\" id=\"{}\">\n<h2>{}</h2>\n", id, escape(case_title(folders, status.name)));
  text += fmt::format("<p class=\"quiet\">Case <code class=\"case-name\">{}</code></p>\n", escape(status.name));
  if (status.state != CaseState::run) text += fmt::format("<p>{}</p>\n", badge(name_of(status.state)));

  // question, blocks and values first, then the rest of the text: reference, model, quantities, limits
  const fs::path readme = page.case_folder() / "README.md";
  std::vector<std::string> sections(1);
  if (fs::exists(readme))
    sections = sections_of(read_text(readme));
  else if (status.state != CaseState::not_modelled)
    text += page.say_missing("This case has no README.md.");
  text += page.render(sections.front(), 1, true);
  const std::string scene = drawn_scene(page);
  text += sketch(page, scene);
  text += parameter_table(page.case_folder() / scene, folders.build / "reports" / "scene_keys.md");
  text += readme_sections(page, sections, {"Problem"}) + blocks(page);
  if (const std::string answer = answer_table(verdicts, status.name); !answer.empty())
    text += "<h3>Values against the reference</h3>\n" + answer;
  text += readme_sections(page, sections, {"Result"}) + readme_sections(page, sections, {"Problem", "Result"}, true);
  const std::string behind = notes(page);  // rendered here, so that a figure of the notes is shown once

  if (status.state != CaseState::not_modelled) {
    const std::string checks = case_tables(verdicts, status.name);
    text += fmt::format("<h3 id=\"{}-checks\">Checks of this run</h3>\n", id);
    text += checks.empty() ? page.say_missing("No check was recorded: the case did not run.") : checks;

    // figures that the text has not shown where it names them
    std::string figures;
    for (const fs::path& script : files_with(page.case_folder(), ".gp"))
      if (!page.shown.contains(script.stem().string())) figures += page.show_figure(script.stem().string(), "");
    if (!figures.empty()) text += "<h3>Figures</h3>\n" + figures;

    const fs::path study = page.study_folder() / "study.md";
    if (fs::exists(study))
      text += fmt::format("<div class=\"study\" id=\"{}-study\">\n<h3>Speed for accuracy</h3>\n{}</div>\n", id,
                          page.render(read_text(study), 1, false));
    else if (fs::exists(page.case_folder() / "study.toml"))
      text += "<h3>Speed for accuracy</h3>\n" + page.say_missing("The study of this case has no result.");
  }
  return text + scene_files(page, scene) + behind + "</section>\n";
}

}  // namespace voussoir::reports
