#include "app/blocks/back_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/bad_input.hpp"
#include "core/base/version.hpp"
#include "core/key_blocks/mass_values.hpp"
#include "core/scene/node.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

constexpr double most_friction = 89 * degree;
constexpr double most_cohesion = 1e9;  // Pa: no rock joint has it
constexpr double closeness = 1e-10;    // relative
constexpr int most_halvings = 200;
constexpr int points_of_line = 10;

// the mass with other strengths of one property
template <int Dim>
class Strengths {
 public:
  Strengths(const Prepared<Dim>& prepared, const SurveyRequest& request, const std::string& name)
      : prepared_(prepared), request_(request) {
    request_.factors_only = true;
    // no stage states another friction from here on
    prepared_.model.properties = properties_of_request(prepared, request);
    for (StagePlan& stage : prepared_.stages) {
      stage.change.friction.reset();
      stage.change.friction_as_stated = false;
      stage.change.friction_of.clear();
    }
    std::vector<std::string> names;
    for (std::size_t p = 0; p < prepared_.model.properties.size(); ++p) {
      const JointProperties& joint = prepared_.model.properties[p];
      names.push_back(joint.name);
      if (joint.name != name) continue;
      if (joint.mobilises() || joint.follows_barton_bandis())
        throw BadInput(
            fmt::format("--back-analysis {}: its friction is no constant angle, so that no line of cohesion and "
                        "friction tells its strength",
                        name));
      places_.push_back(p);
    }
    if (places_.empty())
      throw BadInput(
          fmt::format("--back-analysis {}: no joint_properties of this name; {}", name, suggestion(name, names)));
  }

  // none: nothing moves
  std::optional<double> factor(double friction, double cohesion) {
    for (const std::size_t p : places_) {
      JointProperties& joint = prepared_.model.properties[p];
      joint.friction = friction;
      joint.cohesion = cohesion;
      joint.bonds = BondsMade::as_sliced;
    }
    const Survey<Dim> survey = survey_blocks(prepared_, request_);
    return mass_values(survey).least_factor;
  }
  bool stands(double friction, double cohesion) { return factor(friction, cohesion).value_or(1) >= 1; }

 private:
  Prepared<Dim> prepared_;
  SurveyRequest request_;
  std::vector<std::size_t> places_;
};

// the least value from `low`, where the mass moves, to `high`, where it stands
template <class Stands>
double least_that_stands(double low, double high, const Stands& stands) {
  for (int k = 0; k < most_halvings && high - low > closeness * high; ++k) {
    const double middle = 0.5 * (low + high);
    (stands(middle) ? high : low) = middle;
  }
  return high;
}

template <int Dim>
double least_cohesion(Strengths<Dim>& strengths, double friction) {
  const auto stands = [&](double cohesion) { return strengths.stands(friction, cohesion); };
  if (stands(0)) return 0;
  double high = 1;
  while (!stands(high))
    if ((high *= 10) > most_cohesion)
      throw BadInput(
          fmt::format("--back-analysis: blocks move at a friction of {:g} deg whatever the cohesion: they fall, or "
                      "other joints let "
                      "them go",
                      to_degrees(friction)));
  return least_that_stands(high > 1 ? high / 10 : 0, high, stands);
}

}  // namespace

template <int Dim>
BackAnalysis back_analysis(const Prepared<Dim>& prepared, const SurveyRequest& request, const std::string& properties) {
  Strengths<Dim> strengths(prepared, request, properties);
  BackAnalysis analysis;
  analysis.properties = properties;
  if (strengths.stands(0, 0)) {
    analysis.needs_none = true;
    return analysis;
  }
  if (strengths.stands(most_friction, 0))
    analysis.critical_friction =
        least_that_stands(0.0, most_friction, [&](double friction) { return strengths.stands(friction, 0); });
  const double end = analysis.critical_friction.value_or(most_friction);
  // equal steps of the tangent, along which the line of a single block is straight
  for (int k = 0; k <= points_of_line; ++k) {
    const bool last = k == points_of_line && analysis.critical_friction;
    const double friction = k == points_of_line ? end : std::atan(std::tan(end) * k / points_of_line);
    analysis.line.push_back({friction, last ? 0 : least_cohesion(strengths, friction)});
  }
  return analysis;
}

std::string back_analysis_csv(const BackAnalysis& analysis) {
  std::string text = "friction_deg,cohesion_Pa\n";
  for (const StrengthPair& pair : analysis.line)
    text += fmt::format("{},{}\n", to_degrees(pair.friction), pair.cohesion);
  return text;
}

std::string back_analysis_json(const BackAnalysis& analysis, const std::string& title, const std::string& input_hash) {
  nlohmann::ordered_json values = nlohmann::ordered_json::object();
  if (analysis.critical_friction)
    values["critical_friction"] = {{"value", to_degrees(*analysis.critical_friction)}, {"unit", "deg"}};
  if (!analysis.line.empty())
    values["cohesion_without_friction"] = {{"value", analysis.line.front().cohesion}, {"unit", "Pa"}};
  const nlohmann::ordered_json json = {{"schema", "voussoir.back_analysis"},
                                       {"schema_version", 1},
                                       {"title", title},
                                       {"input_hash", input_hash},
                                       {"program", {{"version", version()}, {"commit", commit()}}},
                                       {"status", "done"},
                                       {"joint_properties", analysis.properties},
                                       {"values", values}};
  return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string back_analysis_text(const BackAnalysis& analysis, const std::string& title) {
  std::string text =
      fmt::format("{} - back-analysis of '{}': the least strength at which every block has a factor of 1\n", title,
                  analysis.properties);
  if (analysis.needs_none) return text + "  no strength of these joints is needed: nothing moves without it\n";
  text += "  friction (deg)  cohesion (kPa)\n";
  for (const StrengthPair& pair : analysis.line)
    text += fmt::format("  {:14.4f}  {:14.6g}\n", to_degrees(pair.friction), pair.cohesion / 1000);
  if (!analysis.critical_friction)
    text += fmt::format("  no friction below {:g} deg is enough without cohesion\n", to_degrees(most_friction));
  return text +
         "other joint_properties keep their strength; what the joints had at failure lies on this line, for the loads "
         "and water stated\n";
}

template BackAnalysis back_analysis<2>(const Prepared<2>&, const SurveyRequest&, const std::string&);
template BackAnalysis back_analysis<3>(const Prepared<3>&, const SurveyRequest&, const std::string&);

}  // namespace voussoir
