#include "app/slice/slice_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/base/arguments.hpp"
#include "app/base/run_scene.hpp"
#include "app/base/section_option.hpp"
#include "app/report/joints_data.hpp"
#include "app/report/report_data.hpp"
#include "app/run_folder/claimed_folder.hpp"
#include "app/run_folder/run_folder.hpp"
#include "app/slice/slice_report.hpp"
#include "app/view/page.hpp"
#include "core/base/bad_input.hpp"
#include "core/exchange/mesh.hpp"
#include "core/exchange/tables.hpp"
#include "core/output/atomic_file.hpp"
#include "core/output/blocks_dxf.hpp"
#include "core/output/paraview.hpp"
#include "core/output/view.hpp"
#include "core/potential/particle.hpp"
#include "core/scene/judge_values.hpp"
#include "text/csv_table.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

struct SliceArguments {
  SceneArguments scene;
  std::filesystem::path out;
  bool view = false;                                           // view.html
  bool report = false;                                         // report.html, on the joint sets, and joints.csv
  bool planes = false, stl = false, obj = false, dxf = false;  // further formats of the blocks
  std::vector<std::string> sections;                           // planes, for section.dxf
  bool overwrite = false;
};

// m: coordinates below this are zero within the rounding of the numbers they were computed from
template <int Dim>
double zero_of(const Model<Dim>& model) {
  double largest = 0;
  for (const Body<Dim>& body : model.bodies)
    largest = std::max(largest, (model.origin + body.reference).norm() + body.radius);
  return 16 * std::numeric_limits<double>::epsilon() * largest;
}

template <int Dim>
std::string block_table(const Model<Dim>& model) {
  const double zero = zero_of(model);
  std::string text = Dim == 3 ? "body,name,volume_m3,faces,inscribed_radius_m,fixed,x_m,y_m,z_m\n"
                              : "body,name,area_m2,faces,inscribed_radius_m,fixed,x_m,y_m\n";
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<Dim>& body = model.bodies[b];
    std::size_t faces = 0;
    for (const Polytope<Dim>& part : body.parts)
      faces += is_particle(part) ? 0 : part.faces.size();
    text +=
        fmt::format("{},{},{},{},{},{}", b, csv_cell(body.name), volume(body), faces, body.size, body.fixed ? 1 : 0);
    const Vector<Dim> centroid = model.origin + body.reference;
    for (int k = 0; k < Dim; ++k)
      text += fmt::format(",{}", std::abs(centroid[k]) < zero ? 0.0 : centroid[k]);
    text += '\n';
  }
  return text;
}

// a name that is valid in a scene
template <int Dim>
std::string name_of(const Model<Dim>& model, std::size_t b) {
  return model.bodies[b].name.empty() ? fmt::format("block-{}", b) : model.bodies[b].name;
}

// calls `add` for every part of every block: name of the block, number, planes and position of the part
template <int Dim, class Add>
void for_parts(const Model<Dim>& model, const Add& add) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    for (std::size_t k = 0; k < model.bodies[b].parts.size(); ++k)
      add(name_of(model, b), static_cast<int>(k), model.bodies[b].parts[k],
          Vector<Dim>(model.origin + model.bodies[b].reference));
}

template <int Dim>
std::string planes(const Model<Dim>& model) {
  std::vector<PlaneRow> rows;
  for_parts(model, [&](const std::string& block, int k, const Polytope<Dim>& part, const Vector<Dim>& place) {
    for (std::size_t f = 0; f < part.faces.size(); ++f) {
      const HalfSpace<Dim> plane = moved_origin<Dim>(part.faces[f], -place);
      const std::string joint = part.joints[f] == no_joint ? "" : model.joints[part.joints[f]].name;
      rows.push_back({0, block, k, joint, {plane.normal.data(), plane.normal.data() + Dim}, plane.offset});
    }
  });
  return plane_table(rows, Dim);
}

std::vector<Mesh> meshes(const Model<3>& model) {
  std::vector<Mesh> all;
  for_parts(model, [&](const std::string& block, int k, const Polytope<3>& part, const Vector<3>& place) {
    Mesh mesh{k == 0 ? block : fmt::format("{}-part-{}", block, k), 0, {}, {}};
    for (const Vector<3>& v : part.vertices)
      mesh.points.push_back(place + v);
    for (const std::vector<int>& loop : part.loops)
      mesh.facets.push_back({loop, 0});
    all.push_back(std::move(mesh));
  });
  return all;
}

template <int Dim>
void write_formats(const Model<Dim>& model, const SliceArguments& arguments) {
  if (arguments.planes) write_file(arguments.out / "block_planes.csv", planes(model));
  if constexpr (Dim == 3) {
    if (arguments.stl) write_file(arguments.out / "blocks.stl", stl_text(meshes(model)));
    if (arguments.obj) write_file(arguments.out / "blocks.obj", obj_text(meshes(model)));
  }
}

Outputs outputs_of(const SliceArguments& arguments) {
  Outputs outputs{"slice", {"blocks.csv", "blocks.vtp"}};
  const auto add = [&](bool wanted, std::initializer_list<const char*> names) {
    if (wanted) outputs.files.insert(outputs.files.end(), names.begin(), names.end());
  };
  add(arguments.view, {"view.bin", "view.html"});
  add(arguments.planes, {"block_planes.csv"});
  add(arguments.stl, {"blocks.stl"});
  add(arguments.obj, {"blocks.obj"});
  add(arguments.dxf, {dxf_file});
  add(!arguments.sections.empty(), {section_file});
  add(arguments.report, {"joints.csv", joints_data_file, report_file});
  return outputs;
}

template <int Dim>
void write_blocks(const Prepared<Dim>& prepared, const std::vector<SectionPolygon>& polygons,
                  const SliceArguments& arguments) {
  const fs::path& folder = arguments.out;
  write_formats(prepared.model, arguments);
  const PolyData faces = block_faces(prepared.model, prepared.state, 0, prepared.joint_sets);
  write_file(folder / "blocks.vtp", vtp(faces));
  if (arguments.dxf) write_file(folder / dxf_file, blocks_dxf(prepared.model, faces));
  if constexpr (Dim == 3)
    if (!polygons.empty()) write_file(folder / section_file, section_dxf(prepared.model, polygons));
  write_file(folder / "blocks.csv", block_table(prepared.model));
  if (arguments.view) {
    begin_view(folder / view_file, prepared);
    write_file(folder / page_file, view_page(folder / view_file));
  }
  fmt::print("{} blocks: {}, {}\n", prepared.model.bodies.size(), (folder / "blocks.vtp").string(),
             (folder / "blocks.csv").string());
}

ExitCode slice_command(const SliceArguments& arguments) {
  const LoadedScene loaded = load_blocks(arguments.scene.scene, arguments.scene.overrides);
  tell_remarks(*loaded.stated);
  if (loaded.dimension == 2 && (arguments.stl || arguments.obj))
    throw BadInput("--stl and --obj write blocks in space but the scene has dimension = 2; use --planes or --dxf");
  const bool particles = std::visit([](const auto& prepared) { return prepared.model.particles; }, loaded.prepared);
  if (particles && (arguments.planes || arguments.stl || arguments.obj))
    throw BadInput(
        "--planes, --stl and --obj write blocks of half-spaces but the scene has potential particles; blocks.vtp has "
        "their surfaces");
  const std::vector<SectionPolygon> polygons = std::visit(
      [&](const auto& prepared) { return section_polygons(prepared.model, arguments.sections); }, loaded.prepared);
  const ClaimedFolder claim(arguments.out, outputs_of(arguments), loaded.files, arguments.overwrite);
  std::visit(
      [&](const auto& prepared) {
        write_blocks(prepared, polygons, arguments);
        if (const std::string endless = endless_joints(*loaded.stated, prepared.model.bodies.size()); !endless.empty())
          fmt::print("{}\n", endless);
      },
      loaded.prepared);
  if (arguments.report) {
    const Scene scene = read_scene(arguments.scene.scene, arguments.scene.overrides);
    const BlockSizes sizes =
        std::visit([](const auto& prepared) { return block_sizes(prepared.model); }, loaded.prepared);
    fmt::print("\n{}", write_slice_report(scene, sizes, arguments.out));
    const fs::path page = arguments.out / report_file;
    write_file(page,
               report_page(report_data(arguments.out, {}), arguments.view ? arguments.out / view_file : fs::path{}));
    fmt::print("\npage: {}\n", page.string());
  }
  return ExitCode::done;
}

}  // namespace

void add_slice(CLI::App& program, Action& action) {
  const auto [command, arguments] =
      add_command(program, action, "slice", "cut the blocks and write them, without running", slice_command);
  add_scene(command, arguments.scene);
  add_out(command, arguments.out, "folder of blocks.vtp and blocks.csv", true);
  command->add_flag(
      "--report", arguments.report,
      "write report.html, a page on joint sets, measured against stated, and on listed joints by their set, with "
      "stereonet, spacings and block sizes; and joints.csv");
  command->add_flag("--view", arguments.view, "write the interactive 3-D page view.html");
  command->add_flag("--planes", arguments.planes,
                    "the planes of the blocks: block_planes.csv, readable as blocks_file");
  command->add_flag("--stl", arguments.stl, "the blocks as blocks.stl (ASCII; 3-D)");
  command->add_flag("--obj", arguments.obj, "the blocks as blocks.obj (3-D), readable as blocks_file");
  command->add_flag("--dxf", arguments.dxf, "blocks and bolts as a drawing for CAD: blocks.dxf");
  add_section(command, arguments.sections, "fixed blocks and others");
  add_overwrite(command, arguments.overwrite);
}

}  // namespace voussoir
