#include "app/export/export_command.hpp"

#include <fmt/format.h>

#include "app/base/bad_input.hpp"
#include "app/base/run_scene.hpp"
#include "app/export/formats.hpp"
#include "app/run_folder/claimed_folder.hpp"
#include "core/output/atomic_file.hpp"
#include "core/scene/scene.hpp"

namespace voussoir {

ExitCode export_command(const ExportArguments& arguments) {
  const LoadedScene loaded = load_scene(arguments.scene.scene, arguments.scene.overrides);
  tell_remarks(*loaded.stated);
  if (loaded.dimension == 2)
    throw BadInput("3DEC and YADE know blocks in space but the scene has dimension = 2; export a scene in space");
  const bool three_dec = arguments.format == "3dec";
  const ExportedScene scene =
      exported(*loaded.stated, std::get<Prepared<3>>(loaded.prepared), three_dec ? "3DEC" : "YADE");
  const std::string text = three_dec ? three_dec_text(scene) : yade_text(scene);
  claim_file(arguments.out, "export", loaded.files, arguments.overwrite);
  write_file(arguments.out, text);
  fmt::print("{} blocks, {} joints: {}\nnot run in {}, nor verified by it; its head lists what was left out\n",
             scene.model->bodies.size(), scene.joints.size(), arguments.out.string(), three_dec ? "3DEC" : "YADE");
  return ExitCode::done;
}

}  // namespace voussoir
