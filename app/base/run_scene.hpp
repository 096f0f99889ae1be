// From a scene file to results in memory: `voussoir run` without files. Cases call it.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/model/prepared.hpp"
#include "core/run/simulate.hpp"

namespace voussoir {

struct Scene;

using AnyPrepared = std::variant<Prepared<2>, Prepared<3>>;

struct LoadedScene {
  std::string title;
  int dimension = 3;
  std::string text;  // the effective scene: the file with its overrides, as TOML
  std::string hash;  // fingerprint of its canonical form, which layout and comments do not change
  std::vector<std::filesystem::path> files;  // that were read
  std::vector<std::string> warnings;         // stated values that look like mistakes, one line each
  std::shared_ptr<const Scene> stated;       // as the file states it
  AnyPrepared prepared;

  // defined in one source: every other one would spend seconds on those of both models
  LoadedScene();
  LoadedScene(const LoadedScene&);
  LoadedScene& operator=(const LoadedScene&);
  LoadedScene(LoadedScene&&) noexcept;
  LoadedScene& operator=(LoadedScene&&) noexcept;
  ~LoadedScene();
};

// Reads, cuts, chooses the solvers. Overrides as after --set: "joints.A.dip=65". Throws SceneError, or BadInput when a
// solver is asked for that is not built in.
LoadedScene load_scene(const std::filesystem::path& path, const std::vector<std::string>& overrides = {},
                       int threads = 1);

// the same if only the blocks of a scene are needed: it need not have a stage
LoadedScene load_blocks(const std::filesystem::path& path, const std::vector<std::string>& overrides = {});

// the same of a scene that has been read, with further overrides
LoadedScene load_changed(const Scene& scene, const std::vector<std::string>& overrides);

// warnings about the files that the scene names, on stderr
void tell_remarks(const Scene& scene);

using ProgressHook = std::function<void(const ProgressReport&)>;

// in memory, from begin to end
Results simulate_scene(const LoadedScene& scene, const ProgressHook& progress = {});

struct SceneRun {
  LoadedScene scene;  // as it was before the first step
  Results results;
};

// load_scene, then simulate_scene
SceneRun run_scene(const std::filesystem::path& path, const std::vector<std::string>& overrides = {}, int threads = 1,
                   const ProgressHook& progress = {});

// features built in besides the core: fast arithmetic
std::vector<std::pair<std::string, bool>> features();

}  // namespace voussoir
