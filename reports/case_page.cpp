#include "reports/case_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "reports/html.hpp"
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
      return drawn_figure({folders.build / "reports" / "figures", study_folder()}, stem, slug(name + "-" + stem),
                          caption);
    } catch (const std::runtime_error& problem) {
      return say_missing(problem.what());
    }
  }

  // inside the manual a file of the repository is an anchor, or only its name
  std::optional<std::string> anchor_of(const std::string& target) const {
    if (target.starts_with("http") || target.starts_with("#")) return target;
    const fs::path path(target);
    if (path.extension() == ".toml" && !path.has_parent_path()) return fmt::format("#{}-{}", slug(name), slug(target));
    if (target == "README.md") return "#" + slug(name);
    if (target == "NOTES.md") return fmt::format("#{}-notes", slug(name));
    if (path.parent_path().parent_path() != "..") return std::nullopt;
    const std::string of_case = "#" + slug(path.parent_path().filename().string());
    if (path.filename() == "README.md") return of_case;
    if (path.filename() == "NOTES.md") return of_case + "-notes";
    return std::nullopt;
  }

  std::string render(const std::string& markdown, int heading_shift, bool leave_out_title) {
    return markdown_to_html(
        markdown, heading_shift, leave_out_title,
        {[this](const std::string& target) { return anchor_of(target); },
         [this](const std::string& target, const std::string& caption) -> std::optional<std::string> {
           return show_figure(fs::path(target).stem().string(), caption);
         }});
  }
};

std::string scene_files(const Page& page) {
  std::string text;
  for (const fs::path& file : files_with(page.case_folder(), ".toml")) {
    const std::string name = file.filename().string();
    text += fmt::format("<details id=\"{}-{}\"{}><summary>{}</summary><pre><code>{}</code></pre></details>\n",
                        slug(page.name), slug(name), name == "scene.toml" ? " open" : "", escape(name),
                        escape(read_text(file)));
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

  // first the text: problem, reference, model, quantities, result, limits
  const fs::path readme = page.case_folder() / "README.md";
  if (fs::exists(readme))
    text += page.render(read_text(readme), 1, true);
  else if (status.state != CaseState::not_modelled)
    text += page.say_missing("This case has no README.md.");
  const std::string behind = notes(page);  // rendered here, so that a figure of the notes is shown once

  if (status.state != CaseState::not_modelled) {
    text += blocks(page);
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
  return text + scene_files(page) + behind + "</section>\n";
}

}  // namespace voussoir::reports
