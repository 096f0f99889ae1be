#include "app/docs/docs_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/base/arguments.hpp"
#include "app/docs/command_pages.hpp"
#include "app/study/keys.hpp"
#include "core/output/monitor.hpp"
#include "core/run/simulate.hpp"
#include "core/scene/keys.hpp"
#include "core/scene/scene.hpp"

namespace voussoir {
namespace {

struct Meaning {
  std::string_view begin;  // of the column's name, or of the monitored quantity's
  std::string_view text;
};

constexpr Meaning column_meanings[] = {
    {"time", "simulated time since the first stage began; in stages that come to rest by relaxation it is fictitious"},
    {"stage", "number of the stage, from 1"},
    {"trial",
     "where some stage searches by trials: the number of one that is taken back; 0: on the path to the answer"},
    {"friction", "friction angle in force, of each of the joint properties whose friction some stage changes"},
    {"water", "present level of each water that some stage changes, as a monitor of its level has it"},
    {"strength_factor",
     "where some stage searches a factor of safety: what the strength of the joint properties that are searched is "
     "divided by"},
};

constexpr Meaning quantity_meanings[] = {
    {"displacement", "of the block's centroid since the first stage began, along the world's axes"},
    {"velocity", "of the centroid, along the world's axes; where a stage relaxes, fictitious"},
    {"rotation",
     "since the first stage began: the rotation vector about the world's axes; in 2-D one column, counter-clockwise"},
    {"angular_velocity", "about the world's axes; in 2-D one column"},
    {"contact_force",
     "of all touching contacts of the joint: the sums of normal force (compression positive), of the sizes of shear "
     "force and of area, "
     "their number, the largest mobilised friction angle, and the angle between the joint's own normal and that of the "
     "contact that carries most"},
    {"whole_bonds", "how many bonds of the joint are whole, each sub-contact that carries one counted"},
    {"level",
     "elevation of the water: of a table in the plane a column for each of its points, m_level_1_m and so on, of a "
     "plane "
     "at the middle of the scene; of a constant pressure m_pressure_Pa instead"},
    {"bolt_force",
     "of one bolt: the largest axial force of the springs of all bolts of the name and the mean, tension positive; how "
     "many springs have yielded and broken"},
    {"convergence",
     "how far the point of the wall has moved towards the opening's centre with its block; of several points a column "
     "each, m_convergence_1_m and so on, or their sum or mean"},
    {"", "sum of the forces of this source on the block"},
};

template <std::size_t Count>
std::string_view meaning_of(std::string_view name, const Meaning (&meanings)[Count]) {
  for (const Meaning& meaning : meanings)
    if (name.starts_with(meaning.begin)) return meaning.text;
  return "";
}

// the columns that a simulation writes, asked of the code that writes them
std::string history_documentation() {
  Prepared<3> example;
  example.model.properties.push_back({.name = "rock"});
  ReducePlan reduction;
  reduction.searched = Searched::factor;
  example.stages.emplace_back().plan = reduction;
  example.model.waters.push_back({.name = "lake", .values = {0, 0, 0}});
  example.stages.back().water.emplace_back();
  std::string text = R"(
# history.csv

`voussoir run` writes one row at each output.history_interval_s, or about 200 rows a stage, and one at the end of each stage; a
search for the critical friction or the factor of safety writes one at the end of each trial. A cell is empty where its number is not finite.

| column | meaning |
|---|---|
)";
  for (const std::string& column : initial_progress(example).results.history.columns)
    text += fmt::format("| `{}` | {} |\n", column, meaning_of(column, column_meanings));
  text +=
      "\nThen the columns of each monitor, which begin with its name, here `m`:\n\n| quantity | columns | meaning "
      "|\n|---|---|---|\n";
  for (const Monitored& followed : monitored_quantities()) {
    std::vector<std::string> headers;
    for (const Column& column : monitor_columns<3>({{"m", followed, 0, 1}}))
      headers.push_back("`" + column.header() + "`");
    text += fmt::format("| {} | {} | {} |\n", followed.word, fmt::join(headers, ", "),
                        meaning_of(followed.word, quantity_meanings));
  }
  return text;
}

ExitCode print_documentation() {
  fmt::print("{}{}{}", scene_documentation(), history_documentation(), study_documentation());
  return ExitCode::done;
}

}  // namespace

void add_docs(CLI::App& program, Action& action) {
  struct Pages {
    bool manual = false, completion = false;
  };
  const auto pages = std::make_shared<Pages>();
  CLI::App* command =
      program.add_subcommand("docs", "every key of scenes and studies and every column of history.csv, as Markdown");
  CLI::Option* manual = command->add_flag("--man", pages->manual, "instead, the page that man voussoir shows (troff)");
  command->add_flag("--completion", pages->completion, "instead, what bash sources to complete the program's arguments")
      ->excludes(manual);
  command->callback([pages, &program, &action] {
    action = [pages, &program] {
      if (!pages->manual && !pages->completion) return print_documentation();
      fmt::print("{}", pages->manual ? manual_page(program) : bash_completion(program));
      return ExitCode::done;
    };
  });
}

}  // namespace voussoir
