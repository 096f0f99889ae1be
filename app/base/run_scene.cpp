#include "app/base/run_scene.hpp"

#include "app/base/message.hpp"
#include "core/base/bad_input.hpp"
#include "core/base/version.hpp"
#include "core/scene/effective_scene.hpp"
#include "core/scene/judge_values.hpp"
#include "core/scene/read_stages.hpp"
#include "core/scene/scene.hpp"

namespace voussoir {
namespace {

template <int Dim>
Prepared<Dim> prepare_to_run(const Scene& scene, int threads) {
  Prepared<Dim> prepared = prepare<Dim>(scene);
  prepared.settings.threads = threads;
  return prepared;
}

template <int Dim>
void load_prepared(const Scene& scene, int threads, LoadedScene& loaded) {
  Prepared<Dim> prepared = prepare_to_run<Dim>(scene, threads);
  loaded.warnings = judge_values<Dim>(scene, prepared);
  loaded.prepared = std::move(prepared);
}

template <int Dim>
Results simulate_prepared(const Prepared<Dim>& prepared, const ProgressHook& hook) {
  Progress<Dim> progress = initial_progress(prepared);
  Watcher<Dim> watcher;
  watcher.progress = hook;
  simulate(prepared, progress, watcher);
  return std::move(progress.results);
}

LoadedScene load(Scene scene, int threads) {
  LoadedScene loaded;
  loaded.dimension = scene.dimension;
  loaded.text = toml_text(*scene.tree);
  loaded.files = scene.files;
  loaded.hash = input_hash(scene);
  if (scene.dimension == 2)
    load_prepared<2>(scene, threads, loaded);
  else
    load_prepared<3>(scene, threads, loaded);
  loaded.title = std::visit([](const auto& prepared) { return prepared.title; }, loaded.prepared);
  loaded.stated = std::make_shared<const Scene>(std::move(scene));
  return loaded;
}

}  // namespace

LoadedScene::LoadedScene() = default;
LoadedScene::LoadedScene(const LoadedScene&) = default;
LoadedScene& LoadedScene::operator=(const LoadedScene&) = default;
LoadedScene::LoadedScene(LoadedScene&&) noexcept = default;
LoadedScene& LoadedScene::operator=(LoadedScene&&) noexcept = default;
LoadedScene::~LoadedScene() = default;

LoadedScene load_scene(const std::filesystem::path& path, const std::vector<std::string>& overrides, int threads) {
  Scene scene = read_scene(path, overrides);
  require_stages(scene);
  return load(std::move(scene), threads);
}

LoadedScene load_blocks(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  return load(read_scene(path, overrides), 1);
}

LoadedScene load_changed(const Scene& scene, const std::vector<std::string>& overrides) {
  return load(read_tree(*scene.tree, scene.file, overrides), 1);
}

void tell_remarks(const Scene& scene) {
  tell_warnings(scene.remarks);
}

Results simulate_scene(const LoadedScene& scene, const ProgressHook& progress) {
  return std::visit([&](const auto& prepared) { return simulate_prepared(prepared, progress); }, scene.prepared);
}

SceneRun run_scene(const std::filesystem::path& path, const std::vector<std::string>& overrides, int threads,
                   const ProgressHook& progress) {
  LoadedScene scene = load_scene(path, overrides, threads);
  Results results = simulate_scene(scene, progress);
  return {std::move(scene), std::move(results)};
}

std::vector<std::pair<std::string, bool>> features() {
  return {{"fast_arithmetic", fast_arithmetic()}};
}

}  // namespace voussoir
