#include "cases/potential_particles/trial.hpp"

#include <ctime>

namespace voussoir::cases {

std::filesystem::path write_scene(const std::string& name, const std::string& text) {
  const std::filesystem::path path = verification::case_output("potential_particles") / (name + ".toml");
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

Trial ask(const std::string& name, const std::string& text, const std::function<double(const SceneRun&)>& answer,
          const std::vector<std::string>& overrides) {
  const std::filesystem::path path = write_scene(name, text);
  Trial trial;
  const auto seconds = [] { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; };
  const double began = seconds();
  SceneRun run{load_scene(path, overrides), {}};
  const double loaded = seconds();
  run.results = simulate_scene(run.scene);
  trial.load_seconds = loaded - began;
  trial.seconds = seconds() - loaded;
  trial.evaluations = run.results.counters.contact_evaluations;
  trial.why = run.results.message;
  trial.answered = run.results.outcome == Outcome::done;
  if (trial.answered) trial.value = answer(run);
  return trial;
}

}  // namespace voussoir::cases
