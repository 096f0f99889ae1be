#include "app/run_folder/begin_run.hpp"

#include <fmt/format.h>

#include "app/run_folder/claimed_folder.hpp"
#include "app/run_folder/run_folder.hpp"
#include "core/base/bad_input.hpp"
#include "core/run/begin.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/shared_stages.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

void require_end_state(const fs::path& folder) {
  std::error_code error;
  const std::string name = folder.string();
  if (!fs::is_directory(folder, error))
    throw BadInput(fmt::format(
        "--begin {0}: there is no such folder; make it with 'voussoir run … --until <stage> --out {0}'", name));
  if (holds_unfinished_run(folder))
    throw BadInput(fmt::format("--begin {0}: the run there has not ended; end it with 'voussoir resume {0}'", name));
  if (!holds_results(folder))
    throw BadInput(fmt::format(
        "--begin {0}: the folder contains no run; make one with 'voussoir run … --until <stage> --out {0}'", name));
  if (!holds_end_state(folder))
    throw BadInput(fmt::format(
        "--begin {}: the run there has not kept its end; run it once more with --until <stage> or --keep", name));
}

template <int Dim>
Progress<Dim> at_end(const fs::path& folder, const Scene& base, const std::string& base_hash, const LoadedScene& scene,
                     const Prepared<Dim>& prepared, std::vector<std::string>& remarks) {
  Progress<Dim> progress = read_end_state<Dim>(folder, base_hash, remarks);
  if (progress.results.outcome != Outcome::done)
    throw BadInput(fmt::format("--begin {}: the run there did not reach its goal ({}); repair it first",
                               folder.string(), progress.results.message));
  if (prepared.last_stage && *prepared.last_stage < progress.stage)
    throw BadInput(
        fmt::format("--until {}: the run in '{}' has done that stage already; name a later one, or leave out "
                    "--begin",
                    prepared.stages[*prepared.last_stage].name, folder.string()));
  const SharedStages shared = require_shared(*scene.stated, base, folder.string(), progress.stage);
  try {
    return begin_at_end(prepared, std::move(progress), shared);
  } catch (const BeginError& error) {
    throw BadInput(fmt::format("--begin {}: the run there {}", folder.string(), error.what()));
  }
}

}  // namespace

std::vector<fs::path> files_begun_with(const fs::path& folder) {
  return {folder / "scene.toml", folder / "run.json", folder / "end_state"};
}

AnyProgress progress_at_end(const fs::path& folder, const LoadedScene& scene, std::vector<std::string>& remarks) {
  const ReadingLock lock(folder);
  require_end_state(folder);
  const Scene base = read_scene(folder / "scene.toml");
  const std::string base_hash = input_hash(base);
  if (base_hash != read_options(folder).scene_hash)
    throw BadInput(other_scene(folder / "scene.toml", read_options(folder).scene_hash, "run it once more"));
  if (base.dimension != scene.dimension)
    throw BadInput(
        fmt::format("--begin {}: dimension = {} there and {} in this scene; begin at the end of a run of "
                    "the same blocks",
                    folder.string(), base.dimension, scene.dimension));
  return std::visit(
      [&](const auto& prepared) -> AnyProgress { return at_end(folder, base, base_hash, scene, prepared, remarks); },
      scene.prepared);
}

}  // namespace voussoir
