#include <fmt/format.h>

#include "app/commands/commands.hpp"
#include "app/run_folder.hpp"
#include "app/run_scene.hpp"
#include "core/output/atomic_file.hpp"
#include "core/output/history_csv.hpp"
#include "core/output/paraview.hpp"

namespace voussoir {
namespace {

template <int Dim>
std::string block_table(const Model<Dim>& model) {
  std::string text = Dim == 3 ? "body,name,volume_m3,faces,inscribed_radius_m,fixed,x_m,y_m,z_m\n"
                              : "body,name,area_m2,faces,inscribed_radius_m,fixed,x_m,y_m\n";
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<Dim>& body = model.bodies[b];
    double volume = 0;
    std::size_t faces = 0;
    for (const Polytope<Dim>& part : body.parts) {
      volume += part.mass.volume;
      faces += part.faces.size();
    }
    text += fmt::format("{},{},{},{},{},{}", b, csv_cell(body.name), volume, faces, body.size, body.fixed ? 1 : 0);
    const Vector<Dim> centroid = model.origin + body.reference;
    for (int k = 0; k < Dim; ++k)
      text += fmt::format(",{}", centroid[k]);
    text += '\n';
  }
  return text;
}

template <int Dim>
void write_blocks(const Prepared<Dim>& prepared, const std::filesystem::path& folder) {
  write_file(folder / "blocks.vtp", vtp(block_faces(prepared.model, prepared.state, 0)));
  write_file(folder / "blocks.csv", block_table(prepared.model));
  fmt::print("{} blocks: {}, {}\n", prepared.model.bodies.size(), (folder / "blocks.vtp").string(),
             (folder / "blocks.csv").string());
}

}  // namespace

ExitCode slice_command(const SliceArguments& arguments) {
  const LoadedScene scene = load_scene(arguments.scene.scene, arguments.scene.overrides);
  const FolderLock lock(arguments.out);
  std::visit([&](const auto& prepared) { write_blocks(prepared, arguments.out); }, scene.prepared);
  return ExitCode::done;
}

}  // namespace voussoir
