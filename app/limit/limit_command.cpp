#include "app/limit/limit_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "app/base/arguments.hpp"
#include "app/base/interruption.hpp"
#include "app/base/message.hpp"
#include "app/base/progress_line.hpp"
#include "app/derivatives/derivative_files.hpp"
#include "app/limit/limit_derivatives.hpp"
#include "app/limit/limit_files.hpp"
#include "app/limit/limit_loads.hpp"
#include "app/run_folder/claimed_folder.hpp"

namespace voussoir {
namespace {

struct LimitArguments {
  SceneArguments scene;
  std::filesystem::path out;            // empty: results/<name of the scene's file>_limit
  std::string load;                     // of limit_load; empty: the critical friction is sought
  std::vector<std::string> properties;  // whose friction is sought; none: all
  bool factor = false;                  // the factor of safety is sought
  std::vector<std::string> joints;      // of whose joint_properties; none: of all
  bool cohesion = false;                // joints have the cohesion that their properties state
  bool with_dilation = false;           // the bound of joints that dilate, alone
  bool decide = false;                  // by runs on elastic joints
  bool proof = false;                   // the load's factor is proved without rounding
  bool derivatives = false;             // of the first value, by the numbers of the scene
  bool overwrite = false;
  bool quiet = false;
};

namespace fs = std::filesystem;

constexpr double long_bound = 2;  // s: hundreds of programs take minutes then

LimitRequest request_of(const LimitArguments& arguments) {
  LimitRequest request;
  request.properties = arguments.factor ? arguments.joints : arguments.properties;
  request.factor = arguments.factor;
  request.cohesion = arguments.cohesion;
  request.with_dilation = arguments.with_dilation;
  request.decide = arguments.decide;
  request.proof = arguments.proof;
  request.load = limit_load(arguments.load);
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
    // two ends that agree are one number
    if (analysis.answered && !analysis.decided && (name.ends_with("_least") || name.ends_with("_largest"))) continue;
    line(analysis.message.empty() && name == analysis.values.front().first ? "result" : "",
         fmt::format("{} {:.9g}{}{}", name, value.value,
                     value.error_bar ? fmt::format(" ± {:.1g}", *value.error_bar) : "",
                     value.unit == "1" ? "" : " " + value.unit));
    if (!value.divides.empty()) line("", fmt::format("{} {}", name, value.divides));
  }
}

// of a block: motion, and where its centre of rotation is
std::string describe(const BlockMotion<2>& motion) {
  return fmt::format(
      "{:>9.4f} {:>9.4f} {:>7.2f} %  {}", motion.speed, motion.turning, 100 * motion.rotation_fraction,
      motion.centre ? fmt::format("({:.4g}, {:.4g})", (*motion.centre)[0], (*motion.centre)[1]) : "translates");
}

std::string describe(const BlockMotion<3>& motion) {
  return fmt::format("{:>9.4f} {:>9.4f} {:>7.2f} % ", motion.speed, motion.turning, 100 * motion.rotation_fraction);
}

template <int Dim>
void print_mechanism(const LimitAnalysis<Dim>& analysis) {
  constexpr std::size_t most_lines = 40;
  const Mechanism<Dim>& mechanism = analysis.mechanism;
  const auto free =
      std::ranges::count_if(analysis.model.bodies, [](const Body<Dim>& body) { return body.present && !body.fixed; });
  if (mechanism.moving.empty()) return line("mechanism", "none");
  line("mechanism",
       fmt::format("{} of {} free blocks move, {} of them rotate; {:.3g} % of the kinetic energy is rotation; {}",
                   mechanism.moving.size(), free, mechanism.turning, 100 * mechanism.rotation_fraction, analysis.flow));
  line("", fmt::format("{:>6} {:>10} {:>10} {}  {:>9} {:>9} {:>9}  {}", "block", "x m", "y m",
                       Dim == 3 ? fmt::format("{:>10}", "z m") : "", "speed", "turning", "rotation",
                       Dim == 2 ? "centre m" : ""));
  for (std::size_t k = 0; k < std::min(mechanism.moving.size(), most_lines); ++k) {
    const BlockMotion<Dim>& motion = mechanism.moving[k];
    const Body<Dim>& body = analysis.model.bodies[motion.body];
    std::string place;
    for (const double x : Vector<Dim>(analysis.model.origin + body.reference))
      place += fmt::format(" {:>10.4g}", x);
    line("",
         fmt::format("{:>6}{}  {}{}{}", motion.body, place, describe(motion), body.name.empty() ? "" : " ", body.name));
  }
  if (mechanism.moving.size() > most_lines) line("", "… all of them in results.json");
  line("",
       "speed of the centroid, turning: speed of the farthest corner about it; their sum is 1 for the fastest block");
}

void print_proof(const ProvedBounds& proof) {
  line("proof", proof.upper ? fmt::format("not more than {:.9g}, proved: beyond it nothing stands", *proof.upper)
                            : "not proved from above: " + proof.no_upper);
  line("", proof.lower ? fmt::format("carried {:.9g} by forces in exact balance, if joints dilate: not safe where they "
                                     "do not",
                                     *proof.lower)
                       : "not proved from below: " + proof.no_lower);
}

template <int Dim>
void print_analysis(const LimitAnalysis<Dim>& analysis, const std::optional<DerivativeTable>& table,
                    const fs::path& folder) {
  const Evidence& evidence = analysis.evidence;
  fmt::print("{}limit analysis\n", analysis.title.empty() ? "" : analysis.title + " - ");
  line("sought", analysis.sought);
  print_values(analysis);
  if (analysis.without_dilation)
    line("dilation",
         fmt::format("none: the lowest mechanism of {} rounds from loose joints{}", analysis.without_dilation->rounds,
                     analysis.without_dilation->converged ? "" : "; not converged: estimates"));
  if (!analysis.values.empty() && analysis.status != LimitStatus::carries_any) {
    line("bound", analysis.bound);
    line("enclosed", fmt::format("for joints that dilate: forces and mechanism differ by {:.2g}, forces out of balance "
                                 "{:.2g} of a block's weight, joints closed at {:.2g} of the speed",
                                 evidence.gap, evidence.out_of_balance, evidence.inadmissible));
  }
  if (analysis.proof) print_proof(*analysis.proof);
  std::size_t corners = 0;
  for (const CornerFace<Dim>& face : analysis.assembly.faces)
    corners += face.corners.size();
  line("solved", fmt::format("{} cone program{} over {} interfaces, {} corners", evidence.programs,
                             evidence.programs == 1 ? "" : "s", analysis.assembly.faces.size(), corners));
  print_mechanism(analysis);
  if (analysis.without_dilation && analysis.without_dilation->apart)
    line("self-stress", fmt::format("holds {} between the two ends: normal forces that the loads do not ask for",
                                    analysis.mechanism.moving.size() == 1
                                        ? "the mechanism's block"
                                        : fmt::format("the mechanism's {} blocks", analysis.mechanism.moving.size())));
  for (const std::string& caveat : analysis.caveats)
    line(&caveat == &analysis.caveats.front() ? "caveat" : "", caveat);
  if (table) fmt::print("{}", derivatives_text(*table));
  fmt::print("results: {}\n", folder.string());
}

ExitCode exit_code(const LimitAnswer& analysis) {
  if (interruption() != 0) return ended_by(interruption());
  if (analysis.status == LimitStatus::solver_failed) return ExitCode::numerical;
  return analysis.answered ? ExitCode::done : ExitCode::incomplete;
}

template <int Dim>
ExitCode answer(const LimitArguments& arguments, const LoadedScene& scene, const LimitAnalysis<Dim>& analysis,
                const std::optional<DerivativeTable>& table, const std::vector<std::string>& files) {
  const fs::path folder = results_folder(arguments);
  const ClaimedFolder claim(folder, {"limit", files}, scene.files, arguments.overwrite);
  tell_remarks(*scene.stated);
  if (!arguments.quiet) tell_warnings(analysis.warnings);
  write_limit_files(analysis, table ? &*table : nullptr, folder);
  if (!arguments.quiet) print_analysis(analysis, table, folder);
  return exit_code(analysis);
}

ExitCode limit_command(const LimitArguments& arguments) {
  const LoadedScene scene = load_scene(arguments.scene.scene, arguments.scene.overrides);
  LimitRequest request = request_of(arguments);
  StatusLine status(!arguments.quiet);
  using Clock = std::chrono::steady_clock;
  const Clock::time_point began = Clock::now();
  note_interruptions();
  request.after_round = [&](int rounds, double factor) {
    if (interruption() != 0) throw StopRounds();
    const double seconds = std::chrono::duration<double>(Clock::now() - began).count();
    if (rounds == 1 && seconds > long_bound && !arguments.quiet)
      tell(
          "voussoir: the bound took {}; without dilation hundreds of programs follow (Ctrl-C ends them and keeps the "
          "bound, --with-dilation seeks no more than it)\n",
          duration_text(seconds));
    if (status.is_due())
      status.show(fmt::format("without dilation: round {} from loose joints, factor {:.6g}", rounds, factor));
  };
  request.on_run = [&](const std::string& what) {
    if (interruption() != 0) throw StopRounds();
    if (status.is_due()) status.show("decide: " + what);
  };
  std::vector<std::string> files{"results.json", "blocks.vtp", "mechanism.vtp", "forces.vtp", "proof.json.gz"};
  if (scene.dimension == 2) files.push_back("limit.svg");
  if (arguments.derivatives) files.insert(files.end(), {derivatives_csv_file, derivatives_svg_file});
  const auto analyse_and_answer = [&]<int Dim>() {
    const LimitAnalysis<Dim> analysis = analyse_limit<Dim>(scene, request);
    std::optional<DerivativeTable> table;
    request.after_round = [](int, double) {
      if (interruption() != 0) throw StopRounds();
    };
    if (arguments.derivatives && interruption() == 0)
      table = limit_derivatives(scene, request, analysis, [&](std::size_t done, std::size_t all) {
        if (status.is_due()) status.show(fmt::format("derivatives: {} of {} keys", done, all));
        return interruption() == 0;
      });
    status.clear();
    return answer(arguments, scene, analysis, table, files);
  };
  return scene.dimension == 3 ? analyse_and_answer.operator()<3>() : analyse_and_answer.operator()<2>();
}

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
          ->add_option(
              "--load", arguments.load,
              "seek the factor of this load at the scene's friction: gravity; or, in addition to "
              "gravity, an acceleration (in the plane to the left or right, in space east, "
              "west, north, south, up or down; or as numbers, 1,0,-0.5), or the applied forces of the first stage that "
              "states any, with factors of time taken as 1 (default: seek the critical "
              "friction under gravity)")
          ->check(CLI::Validator(
              [](const std::string& text) {
                return limit_load(text) ? std::string() : fmt::format("'{}' {}", text, limit_load_rule());
              },
              fmt::format("{{{}}}", fmt::join(named_limit_loads(), ","))));  // as bash completes them
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
  command->add_flag("--with-dilation", arguments.with_dilation,
                    "only the bound on the unsafe side, of joints that dilate by their friction angle: one program "
                    "instead of hundreds");
  command
      ->add_flag("--decide", arguments.decide,
                 "decide by runs of the blocks on their elastic joints, between and beside the ends without dilation")
      ->excludes("--with-dilation");
  command
      ->add_flag("--proof", arguments.proof,
                 "prove the bounds of the load's factor without rounding, as proof.json.gz; for joints that do not "
                 "dilate only the upper one is a bound")
      ->needs(load);
  command
      ->add_flag("--derivatives", arguments.derivatives,
                 "what moves the first value: its derivative by each number of the scene that moves it, with an error "
                 "bar (derivatives.csv, derivatives.svg)")
      ->excludes("--decide");
  add_overwrite(command, arguments.overwrite);
  command->add_flag("--quiet", arguments.quiet, "no warnings and no summary");
}

}  // namespace voussoir
