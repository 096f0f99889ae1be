#include "app/study/search_trial.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <variant>

#include "app/run_folder/results_hash.hpp"
#include "text/angle.hpp"
#include "text/read_file.hpp"

namespace voussoir {
namespace {

// the tolerance beside the way to the limit: one trial closes the bracket
constexpr double one_trial = 1.01;

}  // namespace

std::vector<std::string> trial_at_limit(const Scene& scene, const std::string& quantity, const Fails& fails) {
  if (scene.stages.empty()) return {};
  const StagePlan& last = scene.stages.back().plan;
  const ReducePlan* const plan = std::get_if<ReducePlan>(&last.plan);
  if (!plan || plan->method != ReductionMethod::bisection) return {};
  const bool factor = plan->searched == Searched::factor;
  const double from = factor ? plan->factor.from : plan->from / degree;
  // a factor of safety above the limit stands there, as does a critical friction below it
  if (quantity != (factor ? "factor_of_safety" : "critical_friction") || fails.below != factor) return {};
  if (factor ? !(from < fails.limit) : !(from > fails.limit)) return {};
  const char* const name = factor ? "factor" : "deg";
  return {fmt::format("stage.{}.to_{}={}", last.name, name, fails.limit),
          fmt::format("stage.{}.tolerance_{}={}", last.name, name, one_trial * std::abs(from - fails.limit)),
          "accuracy.budget=false"};
}

std::optional<bool> trial_failed(const std::filesystem::path& folder) {
  const nlohmann::json results = nlohmann::json::parse(read_file(folder / "results.json", largest_results));
  const nlohmann::json states = results.value("at_last_stable_state", nlohmann::json::array());
  if (states.empty()) return std::nullopt;
  if (states.back().contains("last_failed_trial")) return true;
  if (results.at("stages").back().at("ended") == "equilibrium") return false;
  return std::nullopt;
}

}  // namespace voussoir
