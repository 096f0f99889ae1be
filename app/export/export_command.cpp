#include "app/export/export_command.hpp"

#include <fmt/format.h>

#include "app/base/arguments.hpp"
#include "app/base/run_scene.hpp"
#include "app/export/formats.hpp"
#include "app/run_folder/claimed_folder.hpp"
#include "core/base/bad_input.hpp"
#include "core/output/atomic_file.hpp"
#include "core/scene/scene.hpp"

namespace voussoir {
namespace {

struct ExportArguments {
  SceneArguments scene;
  std::string format;         // 3dec, yade
  std::filesystem::path out;  // a file
  bool overwrite = false;
};

ExitCode export_command(const ExportArguments& arguments) {
  const LoadedScene loaded = load_scene(arguments.scene.scene, arguments.scene.overrides);
  tell_remarks(*loaded.stated);
  if (loaded.dimension == 2)
    throw BadInput("3DEC and YADE need blocks in space but the scene has dimension = 2; export a scene in space");
  const bool three_dec = arguments.format == "3dec";
  const ExportedScene scene =
      exported(*loaded.stated, std::get<Prepared<3>>(loaded.prepared), three_dec ? "3DEC" : "YADE");
  const std::string text = three_dec ? three_dec_text(scene) : yade_text(scene);
  claim_file(arguments.out, "export", loaded.files, arguments.overwrite);
  write_file(arguments.out, text);
  fmt::print("{} blocks, {} joints: {}\nthis text was not run in {}; its head lists the features that were left out\n",
             scene.model->bodies.size(), scene.joints.size(), arguments.out.string(), three_dec ? "3DEC" : "YADE");
  return ExitCode::done;
}

}  // namespace

void add_export(CLI::App& program, Action& action) {
  const auto [command, arguments] = add_command(
      program, action, "export",
      "write blocks, joints and properties of a scene in space as text for 3DEC or YADE, which is not run here",
      export_command);
  add_scene(command, arguments.scene);
  command
      ->add_option("--as", arguments.format,
                   "3dec: a data file of 3DEC 7, polyhedra by their faces; yade: a script for YADE with its Polyhedra")
      ->required()
      ->check(CLI::IsMember({"3dec", "yade"}));
  command->add_option("--out", arguments.out, "the file, e.g. scene.dat or scene.py")->required()->check(plain_text());
  add_overwrite(command, arguments.overwrite);
}

}  // namespace voussoir
