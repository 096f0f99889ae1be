// Laboratory tests of a scene's joints: normal compression, direct shear, cycles.
#include "app/joint_test/joint_test_command.hpp"
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "app/base/arguments.hpp"
#include "app/base/message.hpp"
#include "app/base/shown_unit.hpp"
#include "app/run_folder/claimed_folder.hpp"
#include "core/base/bad_input.hpp"
#include "core/joint_laws/barton_bandis.hpp"
#include "core/joint_laws/joint_path.hpp"
#include "core/output/atomic_file.hpp"
#include "core/scene/scene.hpp"
#include "text/angle.hpp"
#include "text/csv_table.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

struct JointTestArguments {
  SceneArguments scene;
  std::filesystem::path out;            // empty: results/<name of the scene's file>_joint_test
  std::vector<std::string> properties;  // names of joint_properties; none: all
  std::string path = "shear";           // normal, shear, stiffness, cyclic
  std::vector<double> stresses;         // Pa; none: 0.1, 0.5, 1, 2, 5 MPa
  std::optional<double> slip;           // m; unstated: 1e-3, or what shows peak and residual strength
  double surroundings = 1e9;            // Pa/m, of the path `stiffness`
  std::optional<double> dilation;       // of the path `stiffness`, of joints that have none; unstated: 0.05
  int cycles = 2;                       // of the path `cyclic`
  int steps = 200;
  bool bonded = false;
  bool overwrite = false;
};

constexpr double usual_dilation = 0.05, usual_slip = 1e-3;
constexpr double usual_stresses[] = {0.1e6, 0.5e6, 1e6, 2e6, 5e6};

// one curve of the table and of the figure
struct JointTest {
  std::string name;
  double stress;  // Pa
  std::vector<JointPathPoint> points;
};

// m. Barton and Bandis' joints are sheared beyond their peak, nearly to the strength of a joint without roughness;
// their slip at the peak is that of the plastic slip, to which the elastic one adds.
double slip_of(const JointProperties& p, double stress) {
  if (!p.follows_barton_bandis()) return usual_slip;
  constexpr double peaks = 25;
  const double peak_slip = p.mobilises() ? p.barton_bandis.peak_slip : 0;
  const double plastic = peak_slip > 0 ? peaks * peak_slip : usual_slip;
  const double shear = stress * friction_answer(p, p.friction, peak_slip, stress).coefficient;
  return plastic + shear / shear_stiffness_at(p, stress);
}

JointPath path_of(const JointTestArguments& arguments, const JointProperties& p, double stress) {
  JointPath path;
  path.normal_stress = stress;
  path.steps = arguments.steps;
  path.bonded = arguments.bonded;
  if (arguments.path == "normal") {
    path.unload = true;
    return path;
  }
  path.slip = arguments.slip ? *arguments.slip : slip_of(p, stress);
  if (arguments.path == "cyclic") path.cycles = arguments.cycles;
  if (arguments.path == "stiffness") {
    path.surroundings = arguments.surroundings;
    if (!p.dilates()) path.dilation = arguments.dilation.value_or(usual_dilation);
  }
  return path;
}

void refuse_two_dilations(const JointProperties& p, const std::optional<double>& dilation) {
  if (p.dilates() && dilation)
    throw BadInput(fmt::format(
        "--dilation: joint_properties.{} have a dilation of their own; leave the option out, or test others "
        "with --joint",
        p.name));
}

std::vector<JointProperties> chosen(const Scene& scene, const std::vector<std::string>& names) {
  std::vector<JointProperties> all, some;
  std::string known;
  for (const PropertiesSpec& spec : scene.properties) {
    all.push_back(spec.properties);
    known += (known.empty() ? "" : ", ") + spec.properties.name;
  }
  if (all.empty()) throw BadInput(scene.file + ": there is no joint to test; add [[joint_properties]]");
  for (const std::string& name : names) {
    const auto at = std::find_if(all.begin(), all.end(), [&](const JointProperties& p) { return p.name == name; });
    if (at == all.end())
      throw BadInput(
          fmt::format("--joint {}: {} has no joint_properties of this name; there are: {}", name, scene.file, known));
    some.push_back(*at);
  }
  for (const JointProperties& p : names.empty() ? all : some)
    if (p.constant_stiffness)
      throw BadInput(
          fmt::format("joint_properties.{}: its stiffness is in N/m, which defines no stress; test joints whose "
                      "stiffness is per area, with --joint",
                      p.name));
  return names.empty() ? all : some;
}

std::string table(const std::vector<JointTest>& tests) {
  std::string text =
      "joint,test_stress_Pa,overlap_m,slip_m,normal_stress_Pa,shear_stress_Pa,normal_stiffness_Pa_per_m,"
      "shear_stiffness_Pa_per_m,plastic_slip_m,friction_coefficient,elastic_J_per_m2,dissipated_J_per_m2,"
      "stiffening_J_per_m2,bonded,snap_back,rise_m,plastic_offset_m,mobilised_friction_deg,dilation_J_per_m2,"
      "irrecoverable_closure_J_per_m2\n";
  for (const JointTest& test : tests)
    for (const JointPathPoint& p : test.points)
      text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_cell(test.name),
                          test.stress, p.overlap, p.slip, p.normal_stress, p.shear_stress, p.normal_stiffness,
                          p.shear_stiffness, p.plastic_slip, p.friction, p.elastic, p.dissipated, p.stiffening,
                          static_cast<int>(p.bond), p.snap_back ? 1 : 0, p.rise, p.offset,
                          to_degrees(std::atan2(std::abs(p.shear_stress), p.normal_stress)), p.dilation, p.crushing);
  return text;
}

// A text of a gnuplot script. Between apostrophes it could not begin with one; between double quotes these characters
// have another meaning.
std::string gnuplot_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char character : text)
    quoted += std::string_view("\"\\`@").find(character) == std::string_view::npos
                  ? std::string(1, character)
                  : fmt::format("\\{:03o}", static_cast<int>(character));
  return quoted + "\"";
}

// Columns that gnuplot finds in the first cell of a row: it takes the second quote as the end of the text, and a comma
// after it as the end of a column.
std::ptrdiff_t columns_of(const std::string& cell) {
  if (!cell.starts_with('"')) return 1;
  return 1 + std::count(cell.begin() + static_cast<std::ptrdiff_t>(cell.find('"', 1)), cell.end(), ',');
}

// columns of the table, as distances from that of the name
enum TableColumn { overlap_column = 2, slip_column = 3, normal_column = 4, shear_column = 5, rise_column = 15 };

// the curves of all tests: one column against another, each in a unit
std::string curves(const std::vector<JointTest>& tests, TableColumn x, const char* x_unit, TableColumn y,
                   const char* y_unit) {
  std::string text;
  std::size_t row = 1;  // behind the header
  for (const JointTest& test : tests) {
    const std::ptrdiff_t first = columns_of(csv_cell(test.name));
    text += fmt::format("{}'joint_test.csv' every ::{}::{} using (${} * {}):(${} * {}) with lines lt {} lw 2 title {}",
                        text.empty() ? "plot " : ", \\\n     ", row, row + test.points.size() - 1, first + x, x_unit,
                        first + y, y_unit, &test - tests.data() + 1,
                        gnuplot_text(fmt::format("{}, {:g} MPa", test.name, test.stress * 1e-6)));
    row += test.points.size();
  }
  return text;
}

// the largest shear strength of a joint, MPa, at a normal stress of x MPa
std::string envelope_of(const JointProperties& p, bool bonded) {
  if (p.follows_barton_bandis()) {
    const double friction = to_degrees(p.friction);
    return fmt::format("x * tan(pi / 180 * ({:.10g} + max(0, min({:.10g}, {:.10g} * log10({:.10g} / max(x, 1e-9))))))",
                       friction, 70 - friction, p.barton_bandis.jrc, 1e-6 * p.barton_bandis.jcs);
  }
  return fmt::format("x * {:.10g} + {:.10g}", std::tan(p.friction), bonded ? 1e-6 * p.cohesion : 0);
}

// shear stress, rise if a joint has one, and the path of both stresses with the strength; the last panel is the key
std::string shear_panels(const std::vector<JointTest>& tests, const std::vector<JointProperties>& tested, bool bonded) {
  std::string text = "min(a, b) = a < b ? a : b\nmax(a, b) = a > b ? a : b\nset multiplot layout 2, 2\nunset key\n";
  const auto panel = [&](const char* x, const char* y, const std::string& plot) {
    text += fmt::format("set xlabel '{}'\nset ylabel '{}'\n{}\n", x, y, plot);
  };
  panel("slip (mm)", "shear stress (MPa)", curves(tests, slip_column, "1e3", shear_column, "1e-6"));
  const auto rises = [](const JointTest& test) {
    return std::ranges::any_of(test.points, [](const JointPathPoint& at) { return at.rise != 0; });
  };
  if (std::ranges::any_of(tests, rises))
    panel("slip (mm)", "rise (mm)", curves(tests, slip_column, "1e3", rise_column, "1e3"));
  std::string envelopes, key;
  for (const JointTest& test : tests)
    key +=
        fmt::format("{}NaN with lines lt {} lw 2 title {}", key.empty() ? "plot " : ", \\\n     ",
                    &test - tests.data() + 1, gnuplot_text(fmt::format("{}, {:g} MPa", test.name, test.stress * 1e-6)));
  for (const JointProperties& p : tested) {
    envelopes += ", \\\n     " + envelope_of(p, bonded) + " with lines lc rgb 'black' dt 2";
    key += ", \\\n     NaN with lines lc rgb 'black' dt 2 title " + gnuplot_text(p.name + ", strength");
  }
  text += "set offsets graph 0, graph 0.05, 0, 0\nset xrange [0:*]\nset samples 400\n";
  panel("normal stress (MPa)", "shear stress (MPa)",
        curves(tests, normal_column, "1e-6", shear_column, "1e-6") + envelopes);
  text += "set key center center noenhanced\nunset border\nunset tics\nunset xlabel\nunset ylabel\nset yrange [0:1]\n" +
          key;
  return text + "\nunset multiplot\n";
}

std::string figure(const std::vector<JointTest>& tests, const std::vector<JointProperties>& tested,
                   const JointTestArguments& arguments) {
  const bool normal = arguments.path == "normal";
  const std::string text = fmt::format(
      "# gnuplot joint_test.gp\nset terminal svg size {} background rgb 'white' font 'sans,13'\n"
      "set output 'joint_test.svg'\nset datafile separator comma\nset key outside right noenhanced\nset grid\n",
      normal ? "760,460" : "980,760");
  if (!normal) return text + shear_panels(tests, tested, arguments.bonded);
  return text + "set xlabel 'closure (µm)'\nset ylabel 'normal stress (MPa)'\n" +
         curves(tests, overlap_column, "1e6", normal_column, "1e-6") + "\n";
}

// the table is the result, the figure an aid: without gnuplot one line names the script that draws it
void draw(const fs::path& folder) {
  const std::string place = fs::absolute(folder).string();
  const bool quotable = place.find('\'') == std::string::npos;
  const bool drawn =
      quotable && std::system(("cd '" + place + "' && gnuplot joint_test.gp >/dev/null 2>&1").c_str()) == 0;
  if (!drawn) tell("voussoir: gnuplot did not draw; the figure's script is {}\n", (folder / "joint_test.gp").string());
}

ExitCode joint_test_command(const JointTestArguments& arguments) {
  const Scene scene = read_scene(arguments.scene.scene, arguments.scene.overrides);
  std::vector<double> stresses = arguments.stresses;
  if (stresses.empty()) stresses.assign(std::begin(usual_stresses), std::end(usual_stresses));
  std::vector<JointTest> tests;
  const std::vector<JointProperties> tested = chosen(scene, arguments.properties);
  for (const JointProperties& p : tested)
    refuse_two_dilations(p, arguments.dilation);
  for (const JointProperties& p : tested)
    for (const double stress : stresses)
      tests.push_back({p.name, stress, follow(p, path_of(arguments, p, stress))});

  const fs::path folder = !arguments.out.empty()
                              ? arguments.out
                              : fs::path("results") / (arguments.scene.scene.stem().string() + "_joint_test");
  const ClaimedFolder claim(folder, {"joint-test", {"joint_test.csv", "joint_test.gp", "joint_test.svg"}}, scene.files,
                            arguments.overwrite);
  write_file(folder / "joint_test.csv", table(tests));
  write_file(folder / "joint_test.gp", figure(tests, tested, arguments));
  draw(folder);

  const ShownUnit stress = shown_unit("Pa");
  fmt::print("{:<16} {:>12} {:>14} {:>14} {:>14} {:>14}\n", "joint", "test " + stress.name, "closure µm",
             "normal " + stress.name, "peak shear " + stress.name, "last shear " + stress.name);
  long long snapped = 0;
  for (const JointTest& test : tests) {
    double peak = 0;
    for (const JointPathPoint& p : test.points) {
      peak = std::max(peak, p.shear_stress);
      snapped += p.snap_back ? 1 : 0;
    }
    const JointPathPoint& last = test.points.back();
    fmt::print("{:<16} {:>12.6g} {:>14.4g} {:>14.6g} {:>14.6g} {:>14.6g}\n", test.name, test.stress / stress.size,
               last.overlap * 1e6, last.normal_stress / stress.size, peak / stress.size,
               last.shear_stress / stress.size);
  }
  if (snapped > 0)
    tell(
        "voussoir: warning: snap-back in {} steps: friction falls faster than the shear spring unloads; a stiffer "
        "spring or a longer softening_slip_m gives a curve that a test can follow",
        snapped);
  fmt::print("table and figure: {}\n", folder.string());
  return ExitCode::done;
}

}  // namespace

void add_joint_test(CLI::App& program, Action& action) {
  const auto [command, arguments] = add_command(
      program, action, "joint-test",
      "drive the joint laws of a scene through laboratory test paths (compression, CNL, CNS)", joint_test_command);
  add_scene(command, arguments.scene);
  add_out(command, arguments.out, "folder of the results (default: results/<scene>_joint_test)");
  add_repeated(command, "--joint", arguments.properties, "name of joint_properties; may be repeated (default: all)")
      ->check(plain_text());
  command
      ->add_option("--path", arguments.path,
                   "normal: compression and unloading; shear: at constant normal stress (CNL); stiffness: at "
                   "constant normal stiffness (CNS); cyclic: to slip, -slip and back (default: shear)")
      ->check(CLI::IsMember({"normal", "shear", "stiffness", "cyclic"}));
  add_repeated(command, "--stress", arguments.stresses,
               "normal stress in Pa; may be repeated (default: 0.1, 0.5, 1, 2, 5 MPa)")
      ->check(finite(least_positive, largest_argument));
  command
      ->add_option("--slip", arguments.slip,
                   "largest slip in m (default: 1e-3; of Barton and Bandis' joints to 25 times the slip at the peak)")
      ->check(finite(least_positive, largest_argument));
  command
      ->add_option("--surroundings", arguments.surroundings,
                   "normal stiffness of the surroundings, for path stiffness, in Pa/m (default: 1e9)")
      ->check(finite(least_positive, largest_argument));
  command
      ->add_option(
          "--dilation", arguments.dilation,
          "dilation over slip, for path stiffness, of joints that do not dilate by a law of their own (default: 0.05)")
      ->check(finite(0, 1));
  command->add_option("--cycles", arguments.cycles, "number of cycles, for path cyclic (default: 2)")
      ->check(CLI::Range(1, 1000));
  command->add_option("--steps", arguments.steps, "points along each leg of a path (default: 200)")
      ->check(CLI::Range(1, 1000000));
  command->add_flag("--bonded", arguments.bonded, "tension and cohesion are intact when shear begins");
  add_overwrite(command, arguments.overwrite);
}

}  // namespace voussoir
