#include "app/blocks/blocks_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "app/base/arguments.hpp"
#include "app/base/message.hpp"
#include "app/base/run_scene.hpp"
#include "app/blocks/blocks_summary.hpp"
#include "app/run_folder/claimed_folder.hpp"
#include "app/run_folder/origin.hpp"
#include "core/base/bad_input.hpp"
#include "core/output/atomic_file.hpp"
#include "core/output/block_verdicts.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

struct BlocksArguments {
  SceneArguments scene;
  fs::path out;  // empty: results/<name of the scene's file>_blocks
  double required = 1.5;
  double fail_below = 0;  // 0: no goal
  std::string seismic, bolt;
  double seismic_vertical = 0;
  std::string strength_of, after;
  bool frictionless = false;
  int top = 20;
  bool overwrite = false;
};

// numbers separated by a slash
std::vector<double> slashed(const std::string& text, const char* option, const char* form) {
  std::vector<double> numbers;
  const char *place = text.data(), *end = place + text.size();
  while (true) {
    double number = 0;
    const auto [next, error] = std::from_chars(place, end, number);
    if (error != std::errc() || !std::isfinite(number) || (next != end && *next != '/'))
      throw BadInput(fmt::format("{} {}: write {}", option, text, form));
    numbers.push_back(number);
    if (next == end) return numbers;
    place = next + 1;
  }
}

std::optional<SeismicRequest> seismic_of(const BlocksArguments& arguments) {
  if (arguments.seismic.empty() && arguments.seismic_vertical == 0) return std::nullopt;
  SeismicRequest request;
  request.vertical = arguments.seismic_vertical;
  if (arguments.seismic.empty()) {
    request.trend = 0;
    return request;
  }
  constexpr const char* form = "a coefficient, or coefficient/trend in degrees, for example 0.12 or 0.12/180";
  const std::vector<double> numbers = slashed(arguments.seismic, "--seismic", form);
  if (numbers.size() > 2 || numbers[0] <= 0 || numbers[0] > 10)
    throw BadInput(
        fmt::format("--seismic {}: write {}; the coefficient is above 0 and at most 10", arguments.seismic, form));
  request.coefficient = numbers[0];
  if (numbers.size() == 2) {
    if (numbers[1] < 0 || numbers[1] > 360)
      throw BadInput(fmt::format("--seismic {}: a trend is from 0 to 360 degrees", arguments.seismic));
    request.trend = numbers[1] * degree;
  }
  return request;
}

std::optional<std::pair<double, double>> bolt_of(const BlocksArguments& arguments) {
  if (arguments.bolt.empty()) return std::nullopt;
  constexpr const char* form = "plunge/trend in degrees of the force on the block, for example 10/350";
  const std::vector<double> numbers = slashed(arguments.bolt, "--bolt", form);
  if (numbers.size() != 2 || std::abs(numbers[0]) > 90 || numbers[1] < 0 || numbers[1] > 360)
    throw BadInput(
        fmt::format("--bolt {}: write {}; plunge from -90 to 90, trend from 0 to 360", arguments.bolt, form));
  return std::pair(numbers[0] * degree, numbers[1] * degree);
}

template <int Dim>
ExitCode judge_scene(const BlocksArguments& arguments, const SurveyRequest& request, const LoadedScene& scene) {
  const Survey<Dim> survey = survey_blocks(std::get<Prepared<Dim>>(scene.prepared), request);
  const fs::path folder =
      arguments.out.empty() ? fs::path("results") / (arguments.scene.scene.stem().string() + "_blocks") : arguments.out;
  const Outputs outputs{"blocks", {"blocks_verdicts.json", "blocks_verdicts.csv", "blocks.vtp"}};
  const ClaimedFolder claim(folder, outputs, scene.files, arguments.overwrite);
  tell_remarks(*scene.stated);
  write_file(folder / "blocks_verdicts.csv", blocks_csv(survey));
  write_file(folder / "blocks.vtp", vtp(block_verdict_faces(survey)));
  write_file(folder / "blocks_verdicts.json", blocks_json(survey, scene.title, scene.hash, {this_origin()}));
  fmt::print("{}results: {}\n", blocks_summary(survey, scene.title, arguments.top), folder.string());
  ExitCode code = ExitCode::done;
  for (const auto* list : {&survey.rows, &survey.clusters})
    for (const SurveyRow<Dim>& row : *list) {
      if (row.kind() == BlockKind::undecided) {
        tell("voussoir: blocks {}: the projection reached its limit of steps\n", survey.body_names(row));
        return ExitCode::numerical;
      }
      if (row.bolted.factor.value_or(arguments.fail_below) < arguments.fail_below) code = ExitCode::incomplete;
    }
  if (code == ExitCode::incomplete)
    fmt::print("a block or cluster has a factor below {:g} (--fail-below)\n", arguments.fail_below);
  return code;
}

ExitCode blocks_command(const BlocksArguments& arguments) {
  SurveyRequest request;
  request.required = arguments.required;
  request.seismic = seismic_of(arguments);
  request.bolt = bolt_of(arguments);
  request.strength_of = arguments.strength_of;
  request.after = arguments.after;
  request.frictionless = arguments.frictionless;
  const LoadedScene scene = load_blocks(arguments.scene.scene, arguments.scene.overrides);
  return scene.dimension == 2 ? judge_scene<2>(arguments, request, scene) : judge_scene<3>(arguments, request, scene);
}

}  // namespace

void add_blocks(CLI::App& program, Action& action) {
  const auto [command, arguments] = add_command(program, action, "blocks",
                                                "which blocks can move, how, and with which factor of safety: block "
                                                "theory on every block as sliced, with clusters",
                                                blocks_command);
  add_scene(command, arguments.scene);
  add_out(command, arguments.out,
          "folder of blocks_verdicts.csv, blocks_verdicts.json and blocks.vtp (default: results/<scene>_blocks)");
  command->add_option("--required", arguments.required, "factor of safety for which forces are found (default 1.5)")
      ->check(finite(least_positive, 1000));
  command
      ->add_option("--fail-below", arguments.fail_below,
                   "end with exit code 1 if a block or cluster has a factor below this")
      ->check(finite(least_positive, 1000));
  command
      ->add_option("--seismic", arguments.seismic,
                   "k or k/TREND: a force of k times the weight on each block towards the trend (deg), in all "
                   "verdicts; without a trend the worst horizontal direction of each block, and the critical "
                   "coefficients, in columns of their own")
      ->check(plain_text());
  command
      ->add_option("--seismic-vertical", arguments.seismic_vertical,
                   "a vertical force of this times the weight on each block, up or down, whichever is worse")
      ->check(finite(least_positive, 10));
  command
      ->add_option("--bolt", arguments.bolt,
                   "PLUNGE/TREND (deg): find the force in this direction on each block for --required")
      ->check(plain_text());
  command
      ->add_option("--strength-of", arguments.strength_of,
                   "stage whose friction is used (default: that of the first search for a factor, else "
                   "joint_properties)")
      ->check(plain_text());
  command
      ->add_option(
          "--after", arguments.after,
          "stage after whose excavations, removals and fixings the blocks are judged, with its loads (default: as "
          "sliced, with the loads of the stage of the strength, or of the last)")
      ->check(plain_text());
  command->add_flag("--frictionless", arguments.frictionless,
                    "successive failure of all blocks that move without friction, too");
  command->add_option("--top", arguments.top, "most lines of the table of blocks (default 20)")
      ->check(CLI::Range(1, 1'000'000));
  add_overwrite(command, arguments.overwrite);
}

}  // namespace voussoir
