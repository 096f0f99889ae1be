#include "app/limit/limit_command.hpp"

#include <fmt/format.h>

#include "app/base/arguments.hpp"
#include "app/limit/limit_loads.hpp"
#include "core/base/bad_input.hpp"
#ifdef VOUSSOIR_HAS_GLPK
#include <algorithm>

#include "app/base/message.hpp"
#include "app/limit/limit_files.hpp"
#include "app/limit/limit_space.hpp"
#include "app/run_folder/claimed_folder.hpp"
#endif

namespace voussoir {
namespace {

struct LimitArguments {
  SceneArguments scene;
  std::filesystem::path out;            // empty: results/<name of the scene's file>_limit
  std::string load;                     // of `limit_loads`; empty: the critical friction is sought
  std::vector<std::string> properties;  // whose friction is sought; none: all
  bool factor = false;                  // the factor of safety is sought
  std::vector<std::string> joints;      // of whose joint_properties; none: of all
  bool cohesion = false;                // joints have the cohesion that their properties state
  bool without_dilation = false;        // also the factor of joints that do not dilate
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
  request.without_dilation = arguments.without_dilation;
  const auto load = std::ranges::find(limit_loads, arguments.load);
  if (load != limit_loads.end()) request.load = static_cast<LimitLoad>(load - limit_loads.begin());
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

void print_values(const LimitAnswer& analysis) {
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

void print_head(const LimitAnswer& analysis) {
  fmt::print("{}limit analysis\n", analysis.title.empty() ? "" : analysis.title + " - ");
  line("sought", analysis.sought);
  print_values(analysis);
}

void print_end(const LimitAnswer& analysis, const fs::path& folder) {
  for (const std::string& caveat : analysis.caveats)
    line(&caveat == &analysis.caveats.front() ? "caveat" : "", caveat);
  fmt::print("results: {}\n", folder.string());
}

void print_analysis(const LimitAnalysis& analysis, const fs::path& folder) {
  const Evidence& evidence = analysis.evidence;
  print_head(analysis);
  line("proof",
       fmt::format("gap between the bounds {:.2g}, forces out of balance {:.2g} of a block's weight, joints closed at "
                   "{:.2g} of the speed",
                   evidence.gap, evidence.out_of_balance, evidence.inadmissible));
  line("", fmt::format("{} linear programs over {} interfaces", evidence.programs, analysis.interfaces.size()));
  print_mechanism(analysis);
  print_end(analysis, folder);
}

void print_mechanism_in_space(const LimitAnalysisInSpace& analysis) {
  constexpr std::size_t most_lines = 20;
  if (analysis.moving.empty()) return line("mechanism", "none");
  const auto free =
      std::ranges::count_if(analysis.model.bodies, [](const Body<3>& body) { return body.present && !body.fixed; });
  line("mechanism",
       fmt::format("{} of {} free blocks move, {} of them rotate", analysis.moving.size(), free, analysis.turning));
  line("", fmt::format("{:>6} {:>10} {:>10} {:>10}  {:>9} {:>9}", "block", "x m", "y m", "z m", "speed", "turning"));
  for (std::size_t k = 0; k < std::min(analysis.moving.size(), most_lines); ++k) {
    const BlockMotionInSpace& motion = analysis.moving[k];
    const Body<3>& body = analysis.model.bodies[motion.body];
    const Vector<3> place = analysis.model.origin + body.reference;
    line("", fmt::format("{:>6} {:>10.4g} {:>10.4g} {:>10.4g}  {:>9.4f} {:>9.4f}  {}", motion.body, place[0], place[1],
                         place[2], motion.speed, motion.turning, body.name));
  }
  if (analysis.moving.size() > most_lines) line("", "… all of them in results.json");
}

void print_analysis(const LimitAnalysisInSpace& analysis, const fs::path& folder) {
  const Evidence& evidence = analysis.evidence;
  print_head(analysis);
  if (!analysis.values.empty()) {
    line("bound", analysis.bound);
    line("enclosed", fmt::format("for joints that dilate: forces and mechanism differ by {:.2g}, forces out of balance "
                                 "{:.2g} of a block's weight, joints closed at {:.2g} of the speed",
                                 evidence.gap, evidence.out_of_balance, evidence.inadmissible));
  }
  std::size_t corners = 0;
  for (const CornerFace& face : analysis.assembly.faces)
    corners += face.corners.size();
  line("solved", fmt::format("{} cone program{} over {} interfaces, {} corners", evidence.programs,
                             evidence.programs == 1 ? "" : "s", analysis.assembly.faces.size(), corners));
  print_mechanism_in_space(analysis);
  print_end(analysis, folder);
}

ExitCode exit_code(const LimitAnswer& analysis) {
  if (analysis.status == LimitStatus::solver_failed) return ExitCode::numerical;
  return analysis.answered ? ExitCode::done : ExitCode::incomplete;
}

template <class Analysis>
ExitCode answer(const LimitArguments& arguments, const LoadedScene& scene, const Analysis& analysis,
                const std::vector<std::string>& files) {
  const fs::path folder = results_folder(arguments);
  const ClaimedFolder claim(folder, {"limit", files}, scene.files, arguments.overwrite);
  tell_remarks(*scene.stated);
  if (!arguments.quiet) tell_warnings(analysis.warnings);
  write_limit_files(analysis, folder);
  if (!arguments.quiet) print_analysis(analysis, folder);
  return exit_code(analysis);
}

ExitCode limit_command(const LimitArguments& arguments) {
  const LoadedScene scene = load_scene(arguments.scene.scene, arguments.scene.overrides);
  const LimitRequest request = request_of(arguments);
  if (scene.dimension == 2)
    return answer(arguments, scene, analyse_limit(scene, request),
                  {"results.json", "limit.svg", "blocks.vtp", "mechanism.vtp", "forces.vtp"});
  return answer(arguments, scene, analyse_limit_in_space(scene, request),
                {"results.json", "blocks.vtp", "mechanism.vtp", "forces.vtp"});
}

#endif

}  // namespace

void add_limit(CLI::App& program, Action& action) {
  const auto [command, arguments] =
      add_command(program, action, "limit",
                  "critical friction angle, factor of safety or collapse load of blocks by "
                  "rigid-block limit analysis",
                  limit_command);
  add_scene(command, arguments.scene);
  add_out(command, arguments.out, "folder of the results (default: results/<scene>_limit)");
  CLI::Option* load =
      command
          ->add_option("--load", arguments.load,
                       "seek the factor of this load at the scene's friction: gravity; or, in addition to "
                       "gravity, an acceleration (in the plane to the left or right, in space east, "
                       "west, north, south, up or down), or the applied forces of the first stage that "
                       "states any, with factors of time taken as 1 (default: seek the critical "
                       "friction under gravity)")
          ->check(CLI::IsMember(limit_loads));
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
  command
      ->add_flag("--without-dilation", arguments.without_dilation,
                 "in space: also the factor of the load for joints that slip without opening, some hundred programs")
      ->needs(load);
  add_overwrite(command, arguments.overwrite);
  command->add_flag("--quiet", arguments.quiet, "no warnings and no summary");
}

}  // namespace voussoir
