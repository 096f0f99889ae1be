#include "app/run/budget_variations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/contact/integrable.hpp"
#include "core/run/reduction.hpp"
#include "core/scene/scene.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

// joints are made stiffer by this factor; softer ones would take a search's elastic displacements beyond its failure
constexpr double stiffer = 4;

// Newton's method: the slip of an increment is divided by this in searches that the required strength judges, by the
// other the increments of other searches
constexpr double less_slip = 5, more_increments = 4;

// a measured stiffness is varied by this factor and reported as a sensitivity
constexpr double sensitivity_change = 1.1;

constexpr int most_face_points = 64;  // of a face, along it
constexpr double most_increments = 1000;

using Overrides = std::vector<std::string>;

// the stiffnesses of all joints that are not measured
Overrides stiffnesses(const std::vector<PropertiesSpec>& properties, double normal, double shear) {
  Overrides overrides;
  for (const PropertiesSpec& spec : properties) {
    if (states(*spec.subject.node, "measured")) continue;
    overrides.push_back(set(spec.subject.path, "normal_stiffness", normal * spec.properties.normal_stiffness));
    overrides.push_back(set(spec.subject.path, "shear_stiffness", shear * spec.properties.shear_stiffness));
  }
  return overrides;
}

Overrides more_points(const std::vector<PropertiesSpec>& properties, const ContactSettings& contact, double times) {
  Overrides overrides;
  for (const PropertiesSpec& spec : properties) {
    const JointProperties& p = spec.properties;
    if (p.constant_stiffness || is_integrated(contact, p) || 2 * p.sub_contacts > most_face_points) continue;
    const int points = static_cast<int>(std::min(std::ceil(times * p.sub_contacts), 1.0 * most_face_points));
    overrides.push_back(fmt::format("{}={}", key_path(spec.subject.path, "sub_contacts"), points));
  }
  return overrides;
}

Variation stiffness(const std::shared_ptr<const Scene>& scene) {
  return {"stiffness", fmt::format("{:g} times", stiffer), stiffer, 1,
          [scene](double f) { return stiffnesses(scene->properties, f, f); }};
}

void add_stiffness(const std::shared_ptr<const Scene>& scene, ResultKind kind, Variations& all) {
  std::vector<Variation>& variations = all.alone;
  const std::vector<PropertiesSpec>& properties = scene->properties;
  for (std::size_t k = 0; k < properties.size(); ++k)
    if (const PropertiesSpec& spec = properties[k]; states(*spec.subject.node, "measured"))
      variations.push_back(
          {"stiffness of " + spec.properties.name, fmt::format("{:g} times", sensitivity_change), sensitivity_change, 0,
           [scene, k](double times) {
             const PropertiesSpec& s = scene->properties[k];
             return Overrides{set(s.subject.path, "normal_stiffness", times * s.properties.normal_stiffness),
                              set(s.subject.path, "shear_stiffness", times * s.properties.shear_stiffness)};
           },
           "", true});
  if (stiffnesses(properties, 1, 1).empty()) return;
  if (kind == ResultKind::no_search || kind == ResultKind::slides) {
    variations.push_back(stiffness(scene));
    return;
  }
  // lower shear stiffness costs no shorter steps
  const Variation shear{"shear stiffness", "a ninth", 9, 0.5,
                        [scene](double f) { return stiffnesses(scene->properties, 1, 1 / f); }};
  all.together.push_back(shear);
  if (kind == ResultKind::turns) return;  // the fit takes out the effect of normal stiffness
  // Overlaps are proportional to 1/kn: softer costs least. A larger effect on a search is the locked-in shear across
  // its sliding surface, with a power of ks/kn below one, about a half. Softer normal springs have both effects.
  variations.push_back({"normal stiffness", "a quarter", 0.25, 0.75,
                        [scene](double f) { return stiffnesses(scene->properties, f, 1); }});
  // by the ratio of both, which stiffer normal springs lower as well: they leave the displacement to the limit of
  // friction unchanged
  all.together.back().refined_by = "normal stiffness";
}

// of Newton's method in searches
void add_increments(const LoadedScene& loaded, const Settings& scene, ResultKind kind, Variations& all) {
  Overrides stages;
  std::vector<std::pair<std::string, int>> numbers;
  for (const Search& search : searches_of(loaded)) {
    const StaticsSettings statics = settings_of(search.stage, scene).statics;
    if (statics.method == Statics::newton) numbers.emplace_back(search.path, statics.increments);
  }
  if (numbers.empty()) return;
  if (kind != ResultKind::by_displacement) {
    all.alone.push_back({"increments", "a fifth of the slip", less_slip, 1, [slip = scene.statics.slip](double f) {
                           return Overrides{set("", "static_slip", slip / f)};
                         }});
    return;
  }
  all.together.push_back({"increments", "4 times as many", more_increments, 1, [numbers](double f) {
                            Overrides overrides;
                            for (const auto& [path, number] : numbers)
                              overrides.push_back(fmt::format("{}={:.0f}", key_path(path, "static_increments"),
                                                              std::min(std::ceil(f * number), most_increments)));
                            return overrides;
                          }});
}

template <int Dim>
Variations variations_of(const LoadedScene& loaded, const Prepared<Dim>& prepared, ResultKind kind) {
  const Settings& settings = prepared.settings;
  const std::shared_ptr<const Scene> scene = loaded.stated;
  Variations all;

  struct StageNumber {
    std::string path;
    double value;
  };
  std::vector<StageNumber> ramps, failures;
  for (const Search& search : searches_of(loaded)) {
    if (search.plan.method == ReductionMethod::bisection || search.plan.method == ReductionMethod::steps)
      ramps.push_back({search.path, static_cast<double>(std::max(search.plan.ramp_steps, 1LL))});
    failures.push_back({search.path, failure_displacement_of(prepared.model, search.plan)});
  }
  add_stiffness(scene, kind, all);
  // First order if loads change with the motion, as water and bolts do: that of a block in a wet joint is. It must be
  // long against the elastic displacement of joints, which shifts the result the other way.
  if (kind == ResultKind::by_displacement)
    all.alone.push_back({"failure displacement", "half", 2, 1, [failures](double f) {
                           Overrides overrides;
                           for (const StageNumber& failure : failures)
                             overrides.push_back(set(failure.path, "failure_displacement", failure.value / f));
                           return overrides;
                         }});

  if (kind != ResultKind::no_search) add_increments(loaded, settings, kind, all);

  std::vector<Variation>& together = all.together;
  if (!ramps.empty())
    together.push_back({"ramp", "twice slower", 2, 1, [ramps](double f) {
                          Overrides overrides;
                          for (const StageNumber& ramp : ramps)
                            overrides.push_back(
                                fmt::format("{}={:.0f}", key_path(ramp.path, "ramp_steps"), std::ceil(f * ramp.value)));
                          return overrides;
                        }});
  const auto add = [&](const char* name, const char* change, double refined, double order, const char* table,
                       const char* key, double value) {
    together.push_back({name, change, refined, order, [=](double f) { return Overrides{set(table, key, value / f)}; }});
  };
  add("rest", "a quarter of equilibrium.unbalanced", 4, 1, "equilibrium", "unbalanced",
      settings.equilibrium.unbalanced);
  if (!settings.time.step) add("time step", "half", 2, 1, "time", "fraction", settings.time.fraction);
  if (settings.damping.local > 0) add("damping", "half", 2, 0, "damping", "local", settings.damping.local);
  if (!more_points(scene->properties, settings.contact, 2).empty())
    together.push_back({"points", "twice as many along a face", 2, 2, [scene, contact = settings.contact](double f) {
                          return more_points(scene->properties, contact, f);
                        }});
  const auto at_points = [&](const PropertiesSpec& p) { return !is_integrated(settings.contact, p.properties); };
  if (settings.contact.normal == ContactNormal::potential && std::ranges::any_of(scene->properties, at_points))
    add("potential radius", "half", 2, 1, "contact", "potential_radius", settings.contact.potential_radius);
  return all;
}

}  // namespace

double Variation::left_by(double shift) const {
  if (most_left > 0) return most_left * shift;
  if (order == 0) return shift;
  const double gain = std::pow(refined, order);
  return shift * gain / (gain - 1);
}

std::optional<double> left_by_measured_order(double shift, double further, double factor, double order) {
  constexpr double least_ratio = 1.1;  // of two shifts that converge
  const double ratio = std::min(shift / further, std::pow(factor, order));
  if (further == 0 || !(ratio >= least_ratio)) return std::nullopt;
  return shift * ratio / (ratio - 1);
}

double part_of(double left) {
  // on the error left by an extrapolation (Roache's grid convergence index, order known)
  constexpr double margin = 1.25;
  return margin * std::abs(left);
}

double Search::tolerance() const {
  return angle() ? plan.tolerance / degree : plan.factor.tolerance;
}

std::string set(const std::string& path, std::string_view key, double value) {
  return fmt::format("{}={:.17g}", key_path(path, key), value);
}

bool states(const Node& table, std::string_view key) {
  const Node* found = table.find(key);
  return found && found->kind == Node::Kind::boolean && found->boolean;
}

std::vector<Search> searches_of(const LoadedScene& scene) {
  const std::vector<Subject> stages = children({scene.stated->tree.get(), ""}, "stage");
  std::vector<Search> searches;
  std::set<std::string> names;
  const auto add = [&](const StagePlan& stage, std::size_t k) {
    const auto* plan = std::get_if<ReducePlan>(&stage.plan);
    if (!plan) return;
    // the first to find one has the bare name
    std::string name = plan->searched == Searched::friction ? "critical_friction" : "factor_of_safety";
    if (!names.insert(name).second) name = stage.name + "_" + name;
    searches.push_back({*plan, stage, item_path("stage", *stages[k].node, k), name});
  };
  std::visit(
      [&](const auto& prepared) {
        for (std::size_t k = 0; k < prepared.stages.size(); ++k)
          add(prepared.stages[k], k);
      },
      scene.prepared);
  return searches;
}

ResultKind kind_of(const LoadedScene& scene, const Results& results) {
  const std::vector<Search> searches = searches_of(scene);
  if (searches.empty()) return ResultKind::no_search;
  ResultKind kind = ResultKind::turns;
  for (const Search& search : searches) {
    const Value* value = results.find(search.value);
    if (!value || !value->error_bar || value->found_by == found_by_fit) continue;
    const bool slides = value->found_by == found_by_strength || (value->found_by == found_by_bracket && !value->turned);
    kind = std::min(kind, slides ? ResultKind::slides : ResultKind::by_displacement);
  }
  return kind;
}

Variations variations_of(const LoadedScene& scene, ResultKind kind) {
  return std::visit([&](const auto& prepared) { return variations_of(scene, prepared, kind); }, scene.prepared);
}

std::optional<Variation> stiffness_of_bar(const LoadedScene& scene, ResultKind kind) {
  if (kind != ResultKind::slides || stiffnesses(scene.stated->properties, 1, 1).empty()) return std::nullopt;
  const Settings& settings = std::visit([](const auto& p) -> const Settings& { return p.settings; }, scene.prepared);
  Variations increments;
  add_increments(scene, settings, kind, increments);
  Variation both = stiffness(scene.stated);
  if (increments.alone.empty()) return both;
  both.change += " (and a fifth of the slip in an increment)";
  both.by = [joints = both.by, slip = increments.alone.front()](double f) {
    Overrides overrides = joints(f);
    for (const std::string& text : slip.overrides())
      overrides.push_back(text);
    return overrides;
  };
  return both;
}

Variation at_once(const std::vector<Variation>& variations) {
  if (variations.size() == 1) return variations.front();
  Variation all{"", fmt::format("{} at once", variations.size())};
  for (const Variation& v : variations) {
    all.name += (all.name.empty() ? "" : ", ") + v.name;
    all.most_left = std::max(all.most_left, v.left_by(1));
  }
  all.by = [variations](double) {
    Overrides overrides;
    for (const Variation& v : variations)
      for (const std::string& text : v.overrides())
        overrides.push_back(text);
    return overrides;
  };
  return all;
}

}  // namespace voussoir
