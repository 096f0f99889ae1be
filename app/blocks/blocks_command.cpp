#include "app/blocks/blocks_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/base/arguments.hpp"
#include "app/base/message.hpp"
#include "app/base/progress_line.hpp"
#include "app/base/run_scene.hpp"
#include "app/base/section_option.hpp"
#include "app/blocks/back_analysis.hpp"
#include "app/blocks/blocks_derivatives.hpp"
#include "app/blocks/blocks_summary.hpp"
#include "app/blocks/blocks_view.hpp"
#include "app/blocks/kinematics_text.hpp"
#include "app/blocks/seismic_option.hpp"
#include "app/derivatives/derivative_files.hpp"
#include "app/run_folder/claimed_folder.hpp"
#include "app/run_folder/origin.hpp"
#include "app/run_folder/results_hash.hpp"
#include "app/run_folder/run_folder.hpp"
#include "app/view/page.hpp"
#include "core/base/bad_input.hpp"
#include "core/limit/block_factor.hpp"
#include "core/output/atomic_file.hpp"
#include "core/output/block_verdicts.hpp"
#include "core/output/blocks_dxf.hpp"
#include "core/output/view.hpp"
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
  bool kinematics = false;
  std::string face;
  double friction = 0;        // deg; 0: that of the joints
  std::string back_analysis;  // name of joint_properties; empty: none
  int top = 20;
  bool view = false;                  // view.html
  bool dxf = false;                   // blocks.dxf
  std::vector<std::string> sections;  // planes, for section.dxf
  bool derivatives = false;           // derivatives.csv, derivatives.svg
  bool overwrite = false;
};

fs::path folder_of(const BlocksArguments& arguments) {
  if (!arguments.out.empty()) return arguments.out;
  const char* what = arguments.kinematics              ? "_kinematics"
                     : arguments.back_analysis.empty() ? "_blocks"
                                                       : "_back_analysis";
  return fs::path("results") / (arguments.scene.scene.stem().string() + what);
}

std::optional<SeismicRequest> seismic_of(const BlocksArguments& arguments) {
  if (arguments.seismic.empty() && arguments.seismic_vertical == 0) return std::nullopt;
  SeismicRequest request;
  if (arguments.seismic.empty())
    request.trend = 0;
  else
    request = seismic_request(arguments.seismic);
  request.vertical = arguments.seismic_vertical;
  return request;
}

std::optional<std::pair<double, double>> bolt_of(const BlocksArguments& arguments) {
  if (arguments.bolt.empty()) return std::nullopt;
  constexpr const char* form = "plunge/trend in degrees of the force on the block, for example 10/350";
  const std::vector<double> numbers = slashed(arguments.bolt, "--bolt", form);
  if (numbers.size() != 2) throw BadInput(fmt::format("--bolt {}: write {}", arguments.bolt, form));
  return std::pair(numbers[0] * degree, numbers[1] * degree);
}

// Their angles are differences between directions, so a friction for each joint has no meaning.
double one_friction(const std::vector<Joint<3>>& joints, const std::vector<JointProperties>& properties) {
  double least = 90 * degree, most = 0;
  for (const Joint<3>& joint : joints) {
    if (joint.holds) continue;
    if (properties[joint.properties].follows_barton_bandis())
      throw BadInput(
          fmt::format("--kinematics: the friction of '{}' depends on the normal stress, and the zones are drawn for "
                      "one angle: state --friction",
                      properties[joint.properties].name));
    least = std::min(least, properties[joint.properties].friction);
    most = std::max(most, properties[joint.properties].friction);
  }
  if (least < most)
    throw BadInput(
        fmt::format("--kinematics: the joints have friction from {:g} to {:g} deg, and the zones are drawn for one: "
                    "state --friction",
                    to_degrees(least), to_degrees(most)));
  return least;
}

// pairs grow with the square: a table of two million rows is 200 MB
constexpr std::size_t most_joints = 2000;

ExitCode analyse_directions(const BlocksArguments& arguments, const SurveyRequest& survey, const LoadedScene& scene) {
  constexpr const char* form = "dip/dip direction of the rock face in degrees, for example 70/180";
  if (arguments.face.empty()) throw BadInput(fmt::format("--kinematics needs --face {}", form));
  const std::vector<double> face = slashed(arguments.face, "--face", form);
  if (face.size() != 2 || face[0] <= 0 || face[0] >= 180 || face[1] < 0 || face[1] > 360)
    throw BadInput(fmt::format("--face {}: write {}; a face that overhangs dips more than 90", arguments.face, form));
  if (scene.dimension == 2) throw BadInput("--kinematics compares directions in space; the scene has dimension = 2");
  const auto& prepared = std::get<Prepared<3>>(scene.prepared);
  std::vector<KinematicJoint> joints;
  std::vector<NamedJoint> named;
  for (std::size_t j = 0; j < prepared.model.joints.size(); ++j) {
    const Joint<3>& joint = prepared.model.joints[j];
    if (joint.holds) continue;
    const int set = prepared.joint_sets.set_of(static_cast<int>(j));
    joints.push_back({joint.plane.normal, set});
    named.push_back({joint.name, set < 0 ? joint.name : prepared.joint_sets.names[set], joint.plane.normal});
  }
  if (joints.size() < 2 || joints.size() > most_joints)
    throw BadInput(
        fmt::format("--kinematics judges pairs of 2 to {} joints; the scene has {}", most_joints, joints.size()));
  const KinematicRequest request{
      .face = {face[0] * degree, face[1] * degree},
      .friction = arguments.friction > 0
                      ? arguments.friction * degree
                      : one_friction(prepared.model.joints, properties_of_request(prepared, survey))};
  const std::vector<PairVerdict> pairs = judge_pairs(request, joints);
  const fs::path folder = folder_of(arguments);
  const ClaimedFolder claim(folder, Outputs{"blocks", {"kinematics.json", "kinematic_pairs.csv", report_file}},
                            scene.files, arguments.overwrite);
  tell_remarks(*scene.stated);
  write_file(folder / "kinematic_pairs.csv", kinematic_pairs_csv(pairs, named));
  const KinematicCounts counts = count_kinematic(request, joints);
  write_file(folder / "kinematics.json", kinematics_json(request, counts, pairs, named, scene.title, scene.hash));
  fmt::print("{}table: {}\nstereonets: voussoir report {}\n", kinematics_summary(request, counts, pairs, scene.title),
             (folder / "kinematic_pairs.csv").string(), folder.string());
  return ExitCode::done;
}

ExitCode analyse_back(const BlocksArguments& arguments, const SurveyRequest& request, const LoadedScene& scene) {
  const BackAnalysis analysis = std::visit(
      [&](const auto& prepared) { return back_analysis(prepared, request, arguments.back_analysis); }, scene.prepared);
  const fs::path folder = folder_of(arguments);
  const ClaimedFolder claim(folder, Outputs{"blocks", {"back_analysis.csv", "results.json"}}, scene.files,
                            arguments.overwrite);
  tell_remarks(*scene.stated);
  write_file(folder / "back_analysis.csv", back_analysis_csv(analysis));
  write_results(folder, back_analysis_json(analysis, scene.title, scene.hash));
  fmt::print("{}results: {}\n", back_analysis_text(analysis, scene.title), folder.string());
  return ExitCode::done;
}

// of blocks whose pressure does not balance the moments of pure sliding
template <int Dim>
void balance_moments(Survey<Dim>& survey) {
  Block<Dim> block;
  for (auto* list : {&survey.rows, &survey.clusters})
    for (SurveyRow<Dim>& row : *list) {
      if (!(row.eccentricity.value_or(0) > 1) && row.kind() != BlockKind::stable) continue;
      gather<Dim>(survey.assembly, row.bodies, {}, block);
      row.factor_moments = factor_with_moments(survey.assembly, block);
    }
}

template <int Dim>
ExitCode judge_scene(const BlocksArguments& arguments, const SurveyRequest& request, const LoadedScene& scene) {
  const auto& prepared = std::get<Prepared<Dim>>(scene.prepared);
  Survey<Dim> survey = survey_blocks(prepared, request);
  balance_moments(survey);
  const Model<Dim>& model = survey.assembly.model;
  const std::vector<SectionPolygon> polygons = section_polygons(model, arguments.sections);
  const fs::path folder = folder_of(arguments);
  Outputs outputs{"blocks",
                  {"blocks_verdicts.json", "blocks_verdicts.csv", "blocks.vtp", "key_blocks.geojson", "results.json"}};
  if (arguments.view)
    for (const char* name : {view_file, page_file})
      outputs.files.emplace_back(name);
  if (arguments.dxf) outputs.files.emplace_back(dxf_file);
  if (!polygons.empty()) outputs.files.emplace_back(section_file);
  if (arguments.derivatives)
    for (const char* name : {derivatives_csv_file, derivatives_svg_file})
      outputs.files.emplace_back(name);
  const ClaimedFolder claim(folder, outputs, scene.files, arguments.overwrite);
  tell_remarks(*scene.stated);
  const std::vector<Origin> origins{this_origin()};
  write_file(folder / "blocks_verdicts.csv", blocks_csv(survey));
  const PolyData faces = block_verdict_faces(survey);
  write_file(folder / "blocks.vtp", vtp(faces));
  if (arguments.dxf) write_file(folder / dxf_file, blocks_dxf(model, faces, key_blocks(survey)));
  if constexpr (Dim == 3)
    if (!polygons.empty()) write_file(folder / section_file, section_dxf(model, polygons, key_blocks(survey)));
  write_file(folder / "blocks_verdicts.json", blocks_json(survey, scene.title, scene.hash, origins));
  if constexpr (Dim == 3) write_file(folder / "key_blocks.geojson", key_blocks_geojson(survey, faces));
  if (arguments.view) write_blocks_view(folder, prepared, survey);
  std::string results = blocks_results_json(survey, scene.title, scene.hash, origins), moves_it;
  if (arguments.derivatives) {
    StatusLine status(true);
    const DerivativeTable table = blocks_derivatives(*scene.stated, request, [&](std::size_t done, std::size_t all) {
      if (status.is_due()) status.show(fmt::format("derivatives: {} of {} keys", done, all));
      return true;
    });
    status.clear();
    write_derivatives(table, folder);
    results = with_derivatives(results, table);
    moves_it = derivatives_text(table);
  }
  // results.json comes last: if it exists, everything is complete
  write_results(folder, results);
  fmt::print("{}{}results: {}\n", blocks_summary(survey, scene.title, arguments.top), moves_it, folder.string());
  if (arguments.view) fmt::print("page: {}\n", (folder / page_file).string());
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
  refuse_out_of_range(request);
  const LoadedScene scene = load_blocks(arguments.scene.scene, arguments.scene.overrides);
  const char* instead = arguments.kinematics              ? "--kinematics compares directions"
                        : arguments.back_analysis.empty() ? nullptr
                                                          : "--back-analysis varies a strength";
  if (instead && (arguments.view || arguments.dxf || !arguments.sections.empty()))
    throw BadInput(fmt::format("--{} shows the verdicts of blocks; {}: leave out one of the two",
                               arguments.view  ? "view"
                               : arguments.dxf ? "dxf"
                                               : "section",
                               instead));
  if (instead && arguments.derivatives)
    throw BadInput(fmt::format("--derivatives are those of the least factor; {}: leave out one of the two", instead));
  if (arguments.kinematics) return analyse_directions(arguments, request, scene);
  if (!arguments.face.empty() || arguments.friction > 0) throw BadInput("--face and --friction belong to --kinematics");
  if (!arguments.back_analysis.empty()) return analyse_back(arguments, request, scene);
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
          "folder of blocks_verdicts.csv, blocks_verdicts.json, blocks.vtp, results.json and in space "
          "key_blocks.geojson (default: results/<scene>_blocks)");
  command->add_option("--required", arguments.required, "factor of safety for which forces are found (default 1.5)");
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
  command->add_option("--seismic-vertical", arguments.seismic_vertical,
                      "a vertical force of this times the weight on each block, up or down, whichever is worse");
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
  command->add_flag("--kinematics", arguments.kinematics,
                    "instead: the zones of plane sliding, wedge sliding and toppling of a rock face, with counts, and "
                    "block theory on every pair of joints (kinematic_pairs.csv in results/<scene>_kinematics)");
  command
      ->add_option(
          "--back-analysis", arguments.back_analysis,
          "instead: the pairs of cohesion and friction of these joint_properties at which the mass just stands "
          "(back_analysis.csv in results/<scene>_back_analysis)")
      ->check(plain_text())
      ->type_name("NAME")
      ->excludes("--kinematics");
  command->add_option("--face", arguments.face, "DIP/DIRECTION (deg) of that face")->check(plain_text());
  command
      ->add_option("--friction", arguments.friction,
                   "deg: of every joint in the kinematic analysis (default: that of the joints)")
      ->check(finite(least_positive, 89));
  command->add_option("--top", arguments.top, "most lines of the table of blocks (default 20)")
      ->check(CLI::Range(1, 1'000'000));
  command->add_flag("--view", arguments.view,
                    "write the interactive page view.html: blocks by factor of safety, with each one's verdict");
  command->add_flag(
      "--dxf", arguments.dxf,
      "write a drawing for CAD, blocks.dxf: key blocks (factor below --required), other blocks and bolts by "
      "layers");
  command->add_flag("--derivatives", arguments.derivatives,
                    "what moves the least factor: its derivative by each number of the scene that moves it, with an "
                    "error bar (derivatives.csv, derivatives.svg)");
  add_section(command, arguments.sections, "key blocks and other blocks");
  add_overwrite(command, arguments.overwrite);
}

}  // namespace voussoir
