#include "app/docs/docs_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/base/arguments.hpp"
#include "app/docs/command_pages.hpp"
#include "app/docs/schema.hpp"
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
    {"time", "simulated time since the first stage began; in stages solved by relaxation it is fictitious"},
    {"stage", "number of the stage, from 1"},
    {"trial", "if some stage searches by trials: the number of a trial that is rejected; 0: on the path to the result"},
    {"friction", "friction angle in force, of each of the joint properties whose friction some stage changes"},
    {"water", "present level of each water that some stage changes, in the columns of a monitor of its level"},
    {"strength_factor",
     "if some stage searches a factor of safety: the factor that divides the strength of the searched joint "
     "properties"},
};

constexpr Meaning quantity_meanings[] = {
    {"displacement", "of the block's centroid since the first stage began, along the world's axes"},
    {"velocity", "of the centroid, along the world's axes; fictitious in a stage that relaxes"},
    {"rotation",
     "since the first stage began: the rotation vector about the world's axes; in 2-D one column, counter-clockwise"},
    {"angular_velocity", "about the world's axes; in 2-D one column"},
    {"contact_force",
     "of all touching contacts of the joint: the sums of normal force (compression positive), of the magnitudes of "
     "shear "
     "force and of area, "
     "their number, the largest mobilised friction angle, and the angle between the joint's own normal and that of the "
     "contact with the largest force"},
    {"whole_bonds", "number of intact bonds of the joint; every bonded sub-contact counts"},
    {"level",
     "elevation of the water: for a table in 2-D a column for each of its points, m_level_1_m and so on, for a "
     "plane "
     "at the middle of the scene; for a constant pressure m_pressure_Pa instead"},
    {"bolt_force",
     "largest and mean axial force of the springs of all bolts of the name, tension positive; numbers of springs that "
     "have yielded and broken"},
    {"convergence",
     "displacement of the wall's point, with its block, towards the opening's centre; for several points a column "
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
search for the critical friction or the factor of safety writes one at the end of each trial. A cell is empty if its number is not finite.

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
    bool manual = false, completion = false, schema = false;
  };
  const auto pages = std::make_shared<Pages>();
  CLI::App* command =
      program.add_subcommand("docs", "every key of scenes and studies and every column of history.csv, as Markdown");
  CLI::Option* manual = command->add_flag("--man", pages->manual, "print the manual page instead (troff)");
  CLI::Option* completion =
      command->add_flag("--completion", pages->completion, "print the completion script for bash instead");
  command->add_flag("--schema", pages->schema, "print a JSON Schema of scenes and studies instead, for editors")
      ->excludes(manual)
      ->excludes(completion);
  completion->excludes(manual);
  command->callback([pages, &program, &action] {
    action = [pages, &program] {
      if (pages->schema)
        fmt::print("{}", files_schema());
      else if (pages->manual || pages->completion)
        fmt::print("{}", pages->manual ? manual_page(program) : bash_completion(program));
      else
        return print_documentation();
      return ExitCode::done;
    };
  });
}

}  // namespace voussoir
