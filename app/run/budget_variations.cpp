#include "app/run/budget_variations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/contact/integrable.hpp"
#include "core/run/reduction.hpp"
#include "core/scene/scene.hpp"

namespace voussoir {
namespace {

// a measured stiffness is varied by this factor and reported as a sensitivity
constexpr double sensitivity_change = 1.1;

constexpr int most_face_points = 64;  // of a face, along it

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

void add_stiffness(const std::shared_ptr<const Scene>& scene, bool searches, Variations& all) {
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
  if (!searches) {
    variations.push_back(
        {"stiffness", "4 times", 4, 1, [scene](double f) { return stiffnesses(scene->properties, f, f); }});
    return;
  }
  // Overlaps are proportional to 1/kn: softer costs least. A larger effect on a search is the locked-in shear across
  // its sliding surface, with a power of ks/kn below one, about a half; lower shear stiffness costs no shorter steps.
  // Softer normal springs have both effects.
  variations.push_back({"normal stiffness", "a quarter", 0.25, 0.75,
                        [scene](double f) { return stiffnesses(scene->properties, f, 1); }});
  // by the ratio of both, which stiffer normal springs lower as well: they leave the displacement to the limit of
  // friction unchanged
  all.together.push_back({"shear stiffness", "a ninth", 9, 0.5,
                          [scene](double f) { return stiffnesses(scene->properties, 1, 1 / f); }, "normal stiffness"});
}

template <int Dim>
Variations variations_of(const LoadedScene& loaded, const Prepared<Dim>& prepared) {
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
  add_stiffness(scene, !failures.empty(), all);
  // It must be long against the elastic displacement of joints and short against a change of geometry, which shift the
  // result in opposite directions: the kind of a shift, and the remaining error, are not known.
  if (!failures.empty())
    all.alone.push_back({"failure displacement", "half", 2, 0, [failures](double f) {
                           Overrides overrides;
                           for (const StageNumber& failure : failures)
                             overrides.push_back(set(failure.path, "failure_displacement", failure.value / f));
                           return overrides;
                         }});

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
  if (order == 0) return shift;
  const double gain = std::pow(refined, order);
  return shift * gain / (gain - 1);
}

double square_of(const BudgetLine& line) {
  // on the error left by an extrapolation (Roache's grid convergence index, order known)
  constexpr double margin = 1.25;
  return line.sensitivity ? 0 : margin * margin * line.left * line.left;
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
    searches.push_back({*plan, item_path("stage", *stages[k].node, k), name});
  };
  std::visit(
      [&](const auto& prepared) {
        for (std::size_t k = 0; k < prepared.stages.size(); ++k)
          add(prepared.stages[k], k);
      },
      scene.prepared);
  return searches;
}

Variations variations_of(const LoadedScene& scene) {
  return std::visit([&](const auto& prepared) { return variations_of(scene, prepared); }, scene.prepared);
}

Variation at_once(const std::vector<Variation>& variations) {
  if (variations.size() == 1) return variations.front();
  Variation all{"", fmt::format("{} at once", variations.size())};
  for (const Variation& v : variations)
    all.name += (all.name.empty() ? "" : ", ") + v.name;
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
