#include "app/import/import_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "app/base/arguments.hpp"
#include "app/base/message.hpp"
#include "app/base/orientation.hpp"
#include "app/import/formats.hpp"
#include "app/report/joints_data.hpp"
#include "app/run_folder/claimed_folder.hpp"
#include "app/view/page.hpp"
#include "core/base/bad_input.hpp"
#include "core/output/atomic_file.hpp"
#include "core/run/checkpoint.hpp"
#include "core/scene/scene_text.hpp"
#include "text/plain_text.hpp"
#include "text/read_file.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

struct ImportArguments {
  std::filesystem::path file;
  std::string format;                     // facets, fab, dxf, traces
  std::filesystem::path out;              // a file
  std::vector<double> shift = {0, 0, 0};  // m, added to coordinates
  bool overwrite = false;
};

constexpr std::uintmax_t largest_import = 64 << 20;  // bytes

ImportedJoints read(const ImportArguments& arguments) {
  using Reader = std::function<ImportedJoints(std::string_view, const Vector<3>&)>;
  static const std::map<std::string, Reader> readers{
      {"facets", read_facets}, {"fab", read_fab}, {"dxf", read_dxf}, {"traces", read_traces}};
  const std::string name = printable(arguments.file.string());
  try {
    return readers.at(arguments.format)(read_file(arguments.file, largest_import),
                                        Eigen::Map<const Vector<3>>(arguments.shift.data()));
  } catch (const ReadFault& fault) {
    throw BadInput(name + ": " + fault.what());
  } catch (const FileFault& fault) {
    std::string place = name;
    for (const int number : {fault.line, fault.column})
      if (number > 0) place += ":" + std::to_string(number);
    throw BadInput(place + ": " + fault.what());
  }
}

// ---- the report

std::string line_text(int line) {
  return line > 0 ? fmt::format("line {}", line) : "";
}

struct LowAndHigh {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void take(double from, double to) {
    low = std::min(low, from);
    high = std::max(high, to);
  }
};

LowAndHigh extent_along(const ImportedJoints& found, int k) {
  LowAndHigh extent;
  for (const JointRow& joint : found.joints) {
    double reach = 0;
    if (found.dimension == 2) reach = joint.extents[0] / 2 * std::abs(joint.normal[1 - k]);
    if (joint.shape == OutlineForm::ellipse) {
      const PlaneAxes<3> axes = plane_axes(Vector<3>(joint.normal.data()));
      reach = std::hypot(axes(k, 0) * joint.extents[0], axes(k, 1) * joint.extents[1]) / 2;
    }
    extent.take(joint.point[k] - reach, joint.point[k] + reach);
    for (const std::vector<double>& corner : joint.corners)
      extent.take(corner[k], corner[k]);
  }
  return extent;
}

// Residuals of fitted planes below the rounding of the file's largest coordinate are printed as 0.
struct Rounded {
  double largest = 0;  // m

  double operator()(double x) const {
    constexpr double relative_rounding = 1e-12;
    return std::abs(x) > relative_rounding * largest ? x : 0.0;
  }
};

Rounded rounded_in(const ImportedJoints& found) {
  Rounded rounded;
  for (int k = 0; k < found.dimension; ++k) {
    const LowAndHigh extent = extent_along(found, k);
    rounded.largest = std::max({rounded.largest, std::abs(extent.low), std::abs(extent.high)});
  }
  return rounded;
}

std::string box_text(const ImportedJoints& found) {
  const Rounded rounded = rounded_in(found);
  std::string text = "box:";
  for (int k = 0; k < found.dimension; ++k) {
    const LowAndHigh extent = extent_along(found, k);
    text +=
        fmt::format("{} {} {:.9g} to {:.9g}", k == 0 ? "" : ",", "xyz"[k], rounded(extent.low), rounded(extent.high));
  }
  return text + " m\n";
}

std::string out_of_plane_text(const ImportedJoints& found) {
  const auto worst = std::max_element(found.out_of_plane.begin(), found.out_of_plane.end());
  if (!worst->has_value()) return "";
  const JointRow& joint = found.joints[worst - found.out_of_plane.begin()];
  return fmt::format("out of plane: at most {:.3g} m ({}, {})\n", rounded_in(found)(**worst), joint.name,
                     line_text(joint.line));
}

std::string dropped_text(const ImportedJoints& found) {
  constexpr std::size_t shown_lines = 5;
  std::map<std::string, std::vector<int>> reasons;
  for (const Dropped& dropped : found.dropped)
    reasons[dropped.reason].push_back(dropped.line);
  std::string text = fmt::format("dropped: {}\n", found.dropped.size());
  for (const auto& [reason, lines] : reasons) {
    text += fmt::format("  {} for {}", lines.size(), reason);
    if (lines.front() > 0) text += lines.size() == 1 ? ": line" : ": lines";
    for (std::size_t k = 0; k < std::min(lines.size(), shown_lines) && lines[k] > 0; ++k)
      text += fmt::format("{} {}", k == 0 ? "" : ",", lines[k]);
    text += lines.size() > shown_lines && lines.front() > 0 ? ", …\n" : "\n";
  }
  return text;
}

template <int Dim>
std::string orientation_text(const std::vector<const JointRow*>& joints) {
  std::vector<Vector<Dim>> normals;
  for (const JointRow* joint : joints)
    normals.emplace_back(joint->normal.data());
  const MeanOrientation mean = mean_orientation<Dim>(normals);
  return fmt::format("{:>8} {:>8.1f} {:>14.1f} {:>10}\n", joints.size(), mean.angles.dip, mean.angles.direction,
                     mean.fisher_constant ? fmt::format("{:.4g}", *mean.fisher_constant) : "-");
}

using Sets = std::map<std::string, std::vector<const JointRow*>>;

Sets sets_of(const ImportedJoints& found) {
  Sets sets;
  for (const JointRow& joint : found.joints)
    sets[joint.set].push_back(&joint);
  return sets;
}

std::string sets_text(const ImportedJoints& found) {
  std::string text =
      fmt::format("{:<24} {:>8} {:>8} {:>14} {:>10}\n", "set", "joints", "dip deg", "direction deg", "Fisher's k");
  for (const auto& [name, joints] : sets_of(found))
    text += fmt::format("{:<24} {}", name.empty() ? "(none)" : name,
                        found.dimension == 3 ? orientation_text<3>(joints) : orientation_text<2>(joints));
  return text;
}

// with the lines that are printed, as they are
std::string page_of(const ImportedJoints& found, const fs::path& file, const std::string& report) {
  nlohmann::ordered_json joints = {{"schema", joints_schema},
                                   {"schema_version", 1},
                                   {"title", "Joints of " + printable(file.filename().string())},
                                   {"program", build_name()},
                                   {"dimension", found.dimension},
                                   {"report", report},
                                   {"notes", found.warnings},
                                   {"sets", nlohmann::ordered_json::array()}};
  for (const auto& [name, members] : sets_of(found)) {
    std::vector<std::vector<double>> normals;
    for (const JointRow* joint : members)
      normals.push_back(joint->normal);
    joints["sets"].push_back({{"name", name}, {"drawn", false}, {"normals", short_normals(normals)}});
  }
  return report_page(json_text({{"joints", joints}}));
}

ExitCode import_command(const ImportArguments& arguments) {
  const ImportedJoints found = read(arguments);
  const std::string table = joint_table(found.joints, found.dimension);
  if (table.size() > largest_scene_file)
    throw BadInput(
        fmt::format("{}: its joints make a table of more than {} MB, the largest that a scene reads; divide the file",
                    printable(arguments.file.string()), largest_scene_file >> 20));
  const fs::path& out = arguments.out;
  const fs::path page = fs::path(out).replace_filename(out.stem().string() + "_report.html");
  for (const fs::path& file : {out, page})
    claim_file(file, "import", {arguments.file}, arguments.overwrite);
  std::string report = fmt::format("joints: {}, {}-D\n", found.joints.size(), found.dimension) + box_text(found) +
                       out_of_plane_text(found) + dropped_text(found);
  for (const std::string& remark : found.remarks)
    report += remark + "\n";
  write_file(out, table);
  write_file(page, page_of(found, arguments.file, report));
  fmt::print("{}{}table: {}\npage: {}\n", report, sets_text(found), out.string(), page.string());
  for (const std::string& warning : found.warnings)
    tell("voussoir: warning: {}: {}\n", printable(arguments.file.string()), warning);
  return ExitCode::done;
}

}  // namespace

void add_import(CLI::App& program, Action& action) {
  const auto [command, arguments] =
      add_command(program, action, "import",
                  "convert joints of a scan, a drawing or a fracture network into a table for scenes (joints_file)",
                  import_command);
  command->add_option("file", arguments.file, "the file")->required()->check(plain_text())->type_name("FILE");
  command
      ->add_option(
          "--as", arguments.format,
          "facets: CloudCompare's table of facets (CSV); fab: FracMan's fractures (ASCII); dxf: 3DFACE, POLYLINE "
          "and LWPOLYLINE of an ASCII DXF, its layers are sets; traces: GeoJSON lines in a plane")
      ->required()
      ->check(CLI::IsMember({"facets", "fab", "dxf", "traces"}));
  command->add_option("--out", arguments.out, "the table, e.g. joints.csv in the folder of the scene")
      ->required()
      ->check(plain_text())
      ->type_name("FILE");
  command
      ->add_option("--shift", arguments.shift,
                   "x,y,z in m, added to every coordinate, e.g. --shift=-458000,-5210000,-900 (traces leave out z)")
      ->delimiter(',')
      ->expected(3)
      ->allow_extra_args(false)
      ->check(finite(-largest_argument, largest_argument));
  command->add_flag("--overwrite", arguments.overwrite,
                    "replace the table and its page; the input file is never replaced");
}

}  // namespace voussoir
