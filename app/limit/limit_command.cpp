#include "app/limit/limit_command.hpp"

#include <fmt/format.h>

#include "app/base/arguments.hpp"
#include "core/base/bad_input.hpp"
#ifdef VOUSSOIR_HAS_GLPK
#include <algorithm>

#include "app/base/message.hpp"
#include "app/limit/limit_files.hpp"
#include "app/run_folder/claimed_folder.hpp"
#endif

namespace voussoir {
namespace {

struct LimitArguments {
  SceneArguments scene;
  std::filesystem::path out;            // empty: results/<name of the scene's file>_limit
  std::string load;                     // gravity, left, right, applied; empty: the critical friction is sought
  std::vector<std::string> properties;  // whose friction is sought; none: all
  bool factor = false;                  // the factor of safety is sought
  std::vector<std::string> joints;      // of whose joint_properties; none: of all
  bool cohesion = false;                // joints have the cohesion that their properties state
  bool overwrite = false;
  bool quiet = false;
};

#ifndef VOUSSOIR_HAS_GLPK

ExitCode limit_command(const LimitArguments&) {
  throw BadInput("limit analysis needs GLPK, which is not built in; configure with -DVOUSSOIR_WITH_GLPK=ON");
}

#else

namespace fs = std::filesystem;

LimitRequest request_of(const LimitArguments& arguments) {
  LimitRequest request;
  request.properties = arguments.factor ? arguments.joints : arguments.properties;
  request.factor = arguments.factor;
  request.cohesion = arguments.cohesion;
  if (arguments.load == "gravity") request.load = LimitLoad::gravity;
  if (arguments.load == "left") request.load = LimitLoad::left;
  if (arguments.load == "right") request.load = LimitLoad::right;
  if (arguments.load == "applied") request.load = LimitLoad::applied;
  return request;
}

fs::path results_folder(const LimitArguments& arguments) {
  if (!arguments.out.empty()) return arguments.out;
  return fs::path("results") / (arguments.scene.scene.stem().string() + "_limit");
}

// one labelled line; only the first line of a group has its label
void line(const char* label, const std::string& text) {
  fmt::print("  {:<12}{}\n", label, text);
}

void print_values(const LimitAnalysis& analysis) {
  if (!analysis.message.empty()) line("result", analysis.message);
  for (const auto& [name, value] : analysis.values) {
    line(analysis.message.empty() && name == analysis.values.front().first ? "result" : "",
         fmt::format("{} {:.9g}{}{}", name, value.value,
                     value.error_bar ? fmt::format(" ± {:.1g}", *value.error_bar) : "",
                     value.unit == "1" ? "" : " " + value.unit));
    if (!value.divides.empty()) line("", fmt::format("{} {}", name, value.divides));
  }
}

void print_mechanism(const LimitAnalysis& analysis) {
  const Mechanism& mechanism = analysis.mechanism;
  const auto free = std::count_if(analysis.model.bodies.begin(), analysis.model.bodies.end(),
                                  [](const Body<2>& body) { return body.present && !body.fixed; });
  if (mechanism.moving.empty()) return line("mechanism", "none");
  line("mechanism",
       fmt::format("{} of {} free blocks move, {} of them rotate; {:.3g} % of the kinetic energy is rotation",
                   mechanism.moving.size(), free, mechanism.turning, 100 * mechanism.rotation_fraction));
  line("", fmt::format("{:>6} {:>10} {:>10}  {:>9} {:>9} {:>9}  {}", "block", "x m", "y m", "speed", "turning",
                       "rotation", "centre m"));
  for (const BlockMotion& motion : mechanism.moving) {
    const Body<2>& body = analysis.model.bodies[motion.body];
    const Vector<2> place = analysis.model.origin + body.reference;
    const std::string centre =
        motion.centre ? fmt::format("({:.4g}, {:.4g})", (*motion.centre)[0], (*motion.centre)[1]) : "translates";
    line("", fmt::format("{:>6} {:>10.4g} {:>10.4g}  {:>9.4f} {:>9.4f} {:>7.2f} %  {}{}", motion.body, place[0],
                         place[1], motion.speed, motion.turning, 100 * motion.rotation_fraction, centre,
                         body.name.empty() ? "" : " " + body.name));
  }
  line("",
       "speed of the centroid, turning: speed of the farthest corner about it; their sum is 1 for the fastest block");
}

void print_analysis(const LimitAnalysis& analysis, const fs::path& folder) {
  const Evidence& evidence = analysis.evidence;
  fmt::print("{}limit analysis\n", analysis.title.empty() ? "" : analysis.title + " - ");
  line("sought", analysis.sought);
  print_values(analysis);
  line("proof",
       fmt::format("gap between the bounds {:.2g}, forces out of balance {:.2g} of a block's weight, joints closed at "
                   "{:.2g} of the speed",
                   evidence.gap, evidence.out_of_balance, evidence.inadmissible));
  line("", fmt::format("{} linear programs over {} interfaces", evidence.programs, analysis.interfaces.size()));
  print_mechanism(analysis);
  for (const std::string& caveat : analysis.caveats)
    line(&caveat == &analysis.caveats.front() ? "caveat" : "", caveat);
  fmt::print("results: {}\n", folder.string());
}

ExitCode exit_code(const LimitAnalysis& analysis) {
  if (analysis.status == LimitStatus::solver_failed) return ExitCode::numerical;
  return analysis.answered ? ExitCode::done : ExitCode::incomplete;
}

ExitCode limit_command(const LimitArguments& arguments) {
  const fs::path folder = results_folder(arguments);
  const LoadedScene scene = load_scene(arguments.scene.scene, arguments.scene.overrides);
  const LimitAnalysis analysis = analyse_limit(scene, request_of(arguments));
  const Outputs outputs{"limit", {"results.json", "limit.svg", "blocks.vtp", "mechanism.vtp", "forces.vtp"}};
  const ClaimedFolder claim(folder, outputs, scene.files, arguments.overwrite);
  tell_remarks(*scene.stated);
  if (!arguments.quiet) tell_warnings(analysis.warnings);
  write_limit_files(analysis, folder);
  if (!arguments.quiet) print_analysis(analysis, folder);
  return exit_code(analysis);
}

#endif

}  // namespace

void add_limit(CLI::App& program, Action& action) {
  const auto [command, arguments] =
      add_command(program, action, "limit",
                  "critical friction angle, factor of safety or collapse load of blocks in "
                  "the plane by rigid-block limit analysis",
                  limit_command);
  add_scene(command, arguments.scene);
  add_out(command, arguments.out, "folder of the results (default: results/<scene>_limit)");
  CLI::Option* load = command
                          ->add_option("--load", arguments.load,
                                       "seek the factor of this load at the scene's friction: gravity; or, in addition "
                                       "to gravity, an acceleration "
                                       "to the left or right, or the applied forces of the first stage that states "
                                       "any, with factors of time taken "
                                       "as 1 (default: seek the critical friction under gravity)")
                          ->check(CLI::IsMember({"gravity", "left", "right", "applied"}));
  add_repeated(command, "--friction", arguments.properties,
               "name of joint_properties whose critical friction is sought; the others keep theirs; may be repeated "
               "(default: all)")
      ->check(plain_text())
      ->excludes(load);
  CLI::Option* factor = command
                            ->add_flag("--factor", arguments.factor,
                                       "seek the factor of safety: the factor that divides tan φ and cohesion when the "
                                       "blocks collapse under gravity")
                            ->excludes(load)
                            ->excludes("--friction");
  add_repeated(command, "--joint", arguments.joints,
               "name of joint_properties whose strength --factor divides; may be repeated (default: all)")
      ->check(plain_text())
      ->needs(factor);
  command->add_flag("--cohesion", arguments.cohesion,
                    "include the cohesion of all joint_properties, also of those that only a stage bonds (those with "
                    "bonds = \"as_sliced\" "
                    "always have theirs); it is plastic, and tension is left out");
  add_overwrite(command, arguments.overwrite);
  command->add_flag("--quiet", arguments.quiet, "no warnings and no summary");
}

}  // namespace voussoir
