// voussoir_study_report: turns the study of one case into points, figures, a recommendation and a page for the manual.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "reports/study_report.hpp"
#include "verification/verdict_file.hpp"

namespace {

namespace fs = std::filesystem;
using voussoir::verification::read_text;
using voussoir::verification::write_atomically;

// one word of a shell command, whatever it holds
std::string quoted(const std::string& text) {
  std::string word = "'";
  for (const char character : text)
    word += character == '\'' ? std::string("'\\''") : std::string(1, character);
  return word + "'";
}

void draw(const voussoir::reports::Study& study, const std::string& quantity, const fs::path& style_folder,
          const fs::path& out) {
  std::string sweeps;
  for (const std::string& sweep : sweeps_of(study, quantity))
    sweeps += (sweeps.empty() ? "" : "|") + sweep;
  std::string command;
  for (const std::string& word :
       {(style_folder / "draw.sh").string(), (style_folder / "study.gp").string(),
        (out / voussoir::reports::study_figure_name(quantity)).string(),
        "points=" + (out / "study_points.csv").string(), "sweeps=" + sweeps, "quantity=" + quantity})
    command += quoted(word) + " ";
  if (std::system(command.c_str()) != 0) throw std::runtime_error("the figure of " + quantity + " was not drawn");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Joins study.csv with reference.json: error against cost, Pareto front, recommendation."};
  fs::path study_file, reference_file, out, style_folder;
  app.add_option("--study", study_file, "what `voussoir study` wrote")->required();
  app.add_option("--reference", reference_file, "reference.json of the case's test")->required();
  app.add_option("--out", out, "folder for study_points.csv, study.md, recommendations.json and the figures")
      ->required();
  app.add_option("--style", style_folder, "folder with draw.sh and study.gp; without it no figure is drawn");
  CLI11_PARSE(app, argc, argv);

  try {
    using namespace voussoir::reports;
    if (!fs::exists(reference_file))
      throw std::runtime_error("there is no " + reference_file.string() +
                               ": the case's test must call CaseReport::reference()");
    const Study study = judge_study(read_study(read_text(study_file)),
                                    read_references(nlohmann::json::parse(read_text(reference_file))));
    write_atomically(out / "study_points.csv", study_points_csv(study));
    write_atomically(out / "recommendations.json", study_recommendations(study).dump(1) + "\n");
    if (!style_folder.empty())
      for (const std::string& quantity : study.quantities)
        draw(study, quantity, style_folder, out);
    write_atomically(out / "study.md", study_markdown(study));
    fmt::print("{} settings judged, {} failed: {}\n", study.points.size(), study.failed.size(),
               (out / "study.md").string());
    return 0;
  } catch (const std::exception& problem) {
    fmt::print(stderr, "voussoir_study_report: {}\n", problem.what());
    return 1;
  }
}
