#include "app/commands/error_budget.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <thread>

#include "app/child_process.hpp"
#include "app/commands/study_found.hpp"
#include "app/commands/study_runs.hpp"
#include "core/contact/carried_whole.hpp"
#include "core/output/fingerprint.hpp"
#include "core/reduction/reduction.hpp"
#include "core/scene/scene_spec.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

// of what an extrapolation leaves (Roache's grid convergence index, order known)
constexpr double margin = 1.25;

// A search first looks through so many brackets of the answer's size, the answer's own among them: where nothing moves
// it ends with the same one.
constexpr int brackets_below = 1, brackets_above = 2;

// of a half bracket: what rounding moves an angle by is no shift
constexpr double rounding = 1e-6;

// a measured stiffness is varied by this, to be told as a sensitivity
constexpr double sensitivity_change = 1.1;

struct Variation {
  std::string name, change;  // "stiffness", "4 times"
  std::vector<std::string> overrides;
  double refined = 1, order = 0;  // by the factor f, where shift f^p / (f^p - 1) is left; order 0: the shift itself is
  bool sensitivity = false;
  std::string folder = {};  // tells scene and program apart from all others, so that what is there is the same run

  double left_by(double shift) const {
    if (order == 0) return shift;
    const double gain = std::pow(refined, order);
    return shift * gain / (gain - 1);
  }
};

std::string set(const std::string& path, std::string_view key, double value) {
  return fmt::format("{}={:.17g}", key_path(path, key), value);
}

bool states(const Node& node, std::string_view key) {
  const Node* found = node.find(key);
  return found && found->kind == Node::Kind::boolean && found->boolean;
}

// a stage that searches, and the path of its keys
struct Search {
  const ReducePlan& plan;
  std::string path, stage;
};

template <int Dim>
std::vector<Search> searches_of(const LoadedScene& scene, const Prepared<Dim>& prepared) {
  const std::vector<Subject> stages = children({scene.stated->tree.get(), ""}, "stage");
  std::vector<Search> searches;
  for (std::size_t k = 0; k < prepared.stages.size(); ++k)
    if (const auto* plan = std::get_if<ReducePlan>(&prepared.stages[k].plan))
      searches.push_back({*plan, item_path("stage", *stages[k].node, k), prepared.stages[k].name});
  return searches;
}

// What is varied: each by itself, and what moves few answers together first, then by itself where that moved something.
struct Variations {
  std::vector<Variation> alone, together;
  Variation all;  // of `together` at once
};

template <int Dim>
Variations variations_of(const LoadedScene& scene, const Prepared<Dim>& prepared) {
  const Settings& settings = prepared.settings;
  Variations all;

  std::vector<std::string> ramps, failures;
  for (const Search& search : searches_of(scene, prepared)) {
    const ReducePlan& plan = search.plan;
    if (plan.method == ReductionMethod::bisection || plan.method == ReductionMethod::steps)
      ramps.push_back(fmt::format("{}={}", key_path(search.path, "ramp_steps"), 2 * std::max(plan.ramp_steps, 1LL)));
    failures.push_back(set(search.path, "failure_displacement", failure_displacement_of(prepared.model, plan) / 2));
  }

  // Overlaps go with 1/k, and what they do to geometry with them. A search is moved more by the shear that settlement
  // locks in, by a power of ks/kn below one: then kn alone is raised, for softer in shear blocks would move by more
  // than the search takes for failure; what ks leaves open the failure displacement tells.
  const bool searches = !failures.empty();
  const double stiffer = searches ? 9 : 4;
  Variation stiffness{
      searches ? "normal stiffness" : "stiffness", fmt::format("{:g} times", stiffer), {}, stiffer, searches ? 0.5 : 1};
  Variation points{"points", "twice as many along a face", {}, 2, 2};
  for (const PropertiesSpec& spec : scene.stated->properties) {
    const JointProperties& p = spec.properties;
    const auto multiply = [&](double normal, double shear, std::vector<std::string>& overrides) {
      overrides.push_back(set(spec.subject.path, "normal_stiffness", normal * p.normal_stiffness));
      overrides.push_back(set(spec.subject.path, "shear_stiffness", shear * p.shear_stiffness));
    };
    if (states(*spec.subject.node, "measured")) {
      all.alone.push_back({"stiffness of " + p.name, fmt::format("{:g} times", sensitivity_change), {}, 1, 0, true});
      multiply(sensitivity_change, sensitivity_change, all.alone.back().overrides);
    } else {
      multiply(stiffer, searches ? 1 : stiffer, stiffness.overrides);
    }
    if (!p.constant_stiffness && !carried_whole(settings.contact, p) && 2 * p.sub_contacts <= 64)
      points.overrides.push_back(fmt::format("{}={}", key_path(spec.subject.path, "sub_contacts"), 2 * p.sub_contacts));
  }
  for (const Variation& v : {stiffness, Variation{"ramp", "twice slower", ramps, 2, 1},
                             Variation{"failure displacement", "half", failures, 2, 1}})
    if (!v.overrides.empty()) all.alone.push_back(v);

  all.together.push_back({"rest",
                          "a quarter of equilibrium.unbalanced",
                          {set("equilibrium", "unbalanced", settings.equilibrium.unbalanced / 4)},
                          4,
                          1});
  if (!settings.time.step)
    all.together.push_back({"time step", "half", {set("time", "fraction", settings.time.fraction / 2)}, 2, 1});
  if (settings.damping.local > 0)
    all.together.push_back({"damping", "half", {set("damping", "local", settings.damping.local / 2)}, 1, 0});
  if (!points.overrides.empty()) all.together.push_back(points);
  const auto at_points = [&](const PropertiesSpec& p) { return !carried_whole(settings.contact, p.properties); };
  if (settings.contact.normal == ContactNormal::potential && std::ranges::any_of(scene.stated->properties, at_points))
    all.together.push_back({"potential radius",
                            "half",
                            {set("contact", "potential_radius", settings.contact.potential_radius / 2)},
                            2,
                            1});

  all.all = {"", "together", {}};
  for (const Variation& v : all.together) {
    all.all.name += (all.all.name.empty() ? "" : ", ") + v.name;
    all.all.overrides.insert(all.all.overrides.end(), v.overrides.begin(), v.overrides.end());
  }
  const std::string run = folder_name(scene.hash + fingerprint(program_bytes()));
  const auto name_folder = [&](Variation& v, std::string name) {
    std::ranges::replace(name, ' ', '_');
    std::erase_if(name, [](char c) { return !(std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-'); });
    v.folder = name + "-" + run;
  };
  for (std::vector<Variation>* some : {&all.alone, &all.together})
    for (Variation& v : *some)
      name_folder(v, v.name);
  name_folder(all.all, all.all.change);
  return all;
}

Variations variations_of(const LoadedScene& scene) {
  return std::visit([&](const auto& prepared) { return variations_of(scene, prepared); }, scene.prepared);
}

constexpr const char* wide = "_wide";  // of a search that begins as the answer's did

// overrides that let the searches of a scene look near what the answer found
template <int Dim>
std::vector<std::string> near(const LoadedScene& scene, const Prepared<Dim>& prepared, const Results& results) {
  std::vector<std::string> overrides;
  std::set<std::string> names;
  for (const Search& search : searches_of(scene, prepared)) {
    const ReducePlan& plan = search.plan;
    if (plan.method != ReductionMethod::bisection) return {};
    const bool angle = plan.searched == Searched::friction;
    // the first to find one has the bare name
    std::string name = angle ? "critical_friction" : "factor_of_safety";
    if (!names.insert(name).second) name = search.stage + "_" + name;
    const Value* found = results.find(name);
    if (!found || !found->error_bar) return {};
    const double unit = angle ? degree : 1, half = *found->error_bar;
    const double from = (angle ? plan.from : plan.factor.from) / unit, to = (angle ? plan.to : plan.factor.to) / unit;
    const double below = found->value - (2 * brackets_below + 1) * half,
                 above = found->value + (2 * brackets_above + 1) * half;
    if (below < std::min(from, to) || above > std::max(from, to)) return {};
    overrides.push_back(set(search.path, angle ? "from_deg" : "from_factor", angle ? above : below));
    overrides.push_back(set(search.path, angle ? "to_deg" : "to_factor", angle ? below : above));
  }
  return overrides;
}

StudyRun run_of(const Variation& v, const fs::path& scene, const std::vector<std::string>& closer,
                const std::string& name) {
  StudyRun run{scene, v.overrides, {}, {scene}, name};
  run.overrides.insert(run.overrides.end(), closer.begin(), closer.end());
  run.overrides.push_back("accuracy.budget=false");
  run.overrides.push_back("output.frames=false");
  return run;
}

// the bar of one value, from the lines of its budget; `other`: the largest half bracket among the variations
void combine(double other, Value& value) {
  value.bracket = value.error_bar;
  const double own = value.error_bar.value_or(0);
  double squares = own * own + other * other;
  for (const BudgetLine& line : value.budget)
    if (!line.sensitivity && std::abs(line.shift) > rounding * own) squares += margin * margin * line.left * line.left;
  value.error_bar = std::sqrt(squares);
  value.covers = "budget";
}

}  // namespace

bool wants_budget(const LoadedScene& scene) {
  const Node* accuracy = scene.stated ? scene.stated->tree->find("accuracy") : nullptr;
  return accuracy && states(*accuracy, "budget");
}

std::vector<std::string> budget_folders(const LoadedScene& scene) {
  const Variations all = variations_of(scene);
  std::vector<Variation> variations = all.alone;
  variations.insert(variations.end(), all.together.begin(), all.together.end());
  variations.push_back(all.all);
  std::vector<std::string> folders;
  for (const Variation& v : variations)
    for (const char* kind : {"", wide})
      folders.push_back("budget/" + v.folder + kind);
  return folders;
}

namespace {

// the budget's runs, in their folder beside the answer
struct Runs {
  const LoadedScene& scene;
  fs::path folder;
  RunsOptions options;
  std::vector<std::string> closer;    // overrides that let searches look near the answer
  std::vector<std::string> searched;  // the values that searches found; without any all are looked at
  long long evaluations = 0;

  // the run of each variation that says something; nothing: interrupted
  std::optional<std::vector<std::string>> carry_out(const std::vector<Variation>& variations) {
    std::vector<std::string> names;
    std::vector<StudyRun> runs, again;
    for (const Variation& v : variations) {
      names.push_back(v.folder);
      runs.push_back(run_of(v, folder / "scene.toml", closer, names.back()));
    }
    if (carry_out_runs(runs, options).interrupted) return {};
    // a search that found nothing near begins where the answer's began
    for (std::size_t k = 0; k < variations.size(); ++k) {
      evaluations += found(names[k], "").contact_evaluations;
      const auto has = [&](const std::string& name) { return found(names[k], name).result.has_value(); };
      if (closer.empty() || std::ranges::all_of(searched, has)) continue;
      names[k] += wide;
      again.push_back(run_of(variations[k], folder / "scene.toml", {}, names[k]));
    }
    if (!again.empty() && carry_out_runs(again, options).interrupted) return {};
    for (const StudyRun& run : again)
      evaluations += found(run.name, "").contact_evaluations;
    return names;
  }

  RunFound found(const std::string& run, const std::string& quantity) const {
    StudyPlan plan;
    plan.quantity = quantity;
    const fs::path at = options.folder / run;
    return fs::exists(at / "results.json") ? found_in(at, plan) : RunFound{.status = "no results"};
  }

  // what monitors say at the end of a search depends on which of its trials was the last
  bool is_judged(const std::string& name) const { return searched.empty() || std::ranges::count(searched, name) > 0; }

  // whether a run has every value that is judged, and each is what it was
  bool moved_nothing(const std::string& run, const Results& results) const {
    return std::ranges::all_of(results.values, [&](const auto& entry) {
      const auto& [name, value] = entry;
      if (!is_judged(name)) return true;
      const RunFound then = found(run, name);
      return then.result &&
             std::abs(then.result->value - value.value) <= rounding * value.error_bar.value_or(std::abs(value.value));
    });
  }
};

}  // namespace

bool add_budget(const LoadedScene& scene, const fs::path& folder, int threads, bool quiet, Results& results) {
  const Variations all = variations_of(scene);
  const fs::path runs_folder = folder / "budget";
  fs::create_directories(runs_folder);
  RunsOptions options;
  options.folder = runs_folder;
  options.jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / threads);
  options.threads = threads;
  options.quiet = quiet;
  Runs runs{scene,
            folder,
            options,
            std::visit([&](const auto& prepared) { return near(scene, prepared, results); }, scene.prepared),
            {}};
  for (const auto& [name, value] : results.values)
    if (value.error_bar) runs.searched.push_back(name);

  std::vector<Variation> variations = all.alone;
  variations.push_back(all.all);
  std::optional<std::vector<std::string>> names = runs.carry_out(variations);
  if (!names) return false;
  if (!runs.moved_nothing(names->back(), results)) {
    const std::optional<std::vector<std::string>> each = runs.carry_out(all.together);
    if (!each) return false;
    variations.pop_back();
    names->pop_back();
    variations.insert(variations.end(), all.together.begin(), all.together.end());
    names->insert(names->end(), each->begin(), each->end());
  }
  results.budget_evaluations = runs.evaluations;

  for (auto& [name, value] : results.values) {
    if (!runs.is_judged(name)) continue;
    double other = 0;
    for (std::size_t k = 0; k < variations.size(); ++k) {
      const Variation& v = variations[k];
      const RunFound then = runs.found((*names)[k], name);
      if (!then.result) {
        results.warnings.push_back(
            fmt::format("the budget of {} knows nothing of {}, {}: {}", name, v.name, v.change, then.status));
        continue;
      }
      const double shift = then.result->value - value.value;
      other = std::max(other, then.result->error_bar.value_or(0));
      value.budget.push_back({v.name, v.change, shift, v.left_by(shift), v.sensitivity});
    }
    if (!value.budget.empty()) combine(other, value);
    std::ranges::stable_sort(value.budget, std::greater{}, [](const BudgetLine& l) { return std::abs(l.left); });
  }
  return true;
}

}  // namespace voussoir
