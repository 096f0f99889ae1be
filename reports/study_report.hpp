#pragma once
// Joins the results of a study with the reference numbers of the case's test: error against cost, and a recommendation.
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/accuracy.hpp"
#include "reports/study_order.hpp"

namespace voussoir::reports {

// Smallest error that is drawn and listed, in place of anything closer: a logarithm needs a number above zero, and a
// thousandth of the finest promise of accuracy.hpp is practically exact when settings are chosen.
constexpr double relative_error_floor = 1e-6;

// One line of study.csv: one setting of one knob, one quantity.
struct StudyRow {
  std::string sweep, key, value, unit;
  std::string quantity, result_unit;
  std::optional<double> result;  // unset when the setting failed
  double error_bar = 0.0;        // of the result, in its unit: half the bracket of a bisection, …
  std::string status;            // "ok", or the name of the failure
  long long contact_evaluations = 0;
  long long steps = 0;
  double seconds = 0.0;

  // the knob, if it is a number
  std::optional<double> number() const;
};

struct Reference {
  double value = 0.0;
  std::string unit;
};

struct StudyPoint {
  StudyRow row;
  double relative_error = 0.0;        // not below relative_error_floor
  double relative_error_upper = 0.0;  // error plus error bar: the accuracy that is reached with certainty
  bool pareto = false;                // no other setting is both as cheap and as accurate
};

struct Recommendation {
  std::string quantity;
  double level = 0.0;                  // one of accuracy_promises
  std::optional<StudyPoint> cheapest;  // unset when no setting reaches the level
};

// of one sweep over a knob that is a number
struct SweepOrder {
  std::string quantity, sweep, key;
  std::optional<ObservedOrder> order;  // unset when the error does not fall with the knob
};

struct Study {
  std::vector<std::string> quantities;  // those with a reference, in order of appearance
  std::vector<StudyPoint> points;
  std::vector<StudyRow> failed;
  std::vector<std::string> unjudged;  // reasons why a quantity has no error: one sentence each
  std::vector<Recommendation> recommendations;
  std::vector<SweepOrder> orders;
};

// the scene's key that takes one of accuracy_levels
inline constexpr std::string_view level_key = "accuracy.level";

// One line for every level that a study sweeps and that misses its promise; empty when all keep it.
std::string broken_promises(const Study& study);

// The sweep in which `voussoir study` runs the scene as it is.
inline constexpr std::string_view default_sweep = "default";

// The unit of cost: contact evaluations, or steps in a study in which nothing ever touches.
enum class CostUnit { contact_evaluations, steps };
CostUnit cost_unit(const Study& study);
const char* name_of(CostUnit unit);
double cost_of(const StudyPoint& point, CostUnit unit);

// the scene as it is; null when that failed
const StudyPoint* default_point(const Study& study, std::string_view quantity);

// Throws std::runtime_error, naming the column or the line, for anything else than the columns of `voussoir study`.
std::vector<StudyRow> read_study(std::string_view csv);

// {"critical_friction": {"value": 33.357, "unit": "deg"}, …}
std::map<std::string, Reference> read_references(const nlohmann::json& text);

// Throws std::runtime_error when a unit differs between study and reference, or when no quantity can be judged.
Study judge_study(const std::vector<StudyRow>& rows, const std::map<std::string, Reference>& references);

std::string study_points_csv(const Study& study);  // for gnuplot
std::string study_markdown(const Study& study);    // for the manual
nlohmann::json study_json(const Study& study);     // for programs: reports/trade.hpp

// Sweeps that have points for the quantity, in order of appearance.
std::vector<std::string> sweeps_of(const Study& study, std::string_view quantity);

// study_<quantity>.svg, with letters, digits and underscores only.
std::string study_figure_name(std::string_view quantity);

}  // namespace voussoir::reports
