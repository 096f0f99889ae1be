#include "app/blocks/verdict_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "core/geometry/plunge_trend.hpp"
#include "core/output/block_verdicts.hpp"

namespace voussoir {
namespace {

constexpr double rounding_of_directions = 1e-12;
constexpr double near_edge = 0.9;  // pressure eccentricity from which a block is near to turning

}  // namespace

template <int Dim>
std::string kind_label(const SurveyRow<Dim>& row) {
  if (row.kind() != BlockKind::slides) return word_of(row.kind());
  const int loaded = row.bolted.verdict.loaded;
  return row.bolted.verdict.indeterminate ? "slides along a line that more than two faces share"
                                          : fmt::format("slides on {}", loaded == 1 ? "one face" : "two faces");
}

template <int Dim>
std::string joints_shown(const Survey<Dim>& survey, const SurveyRow<Dim>& row) {
  return fmt::format("{}", fmt::join(loaded_joints(survey, row), ", "));
}

template <int Dim>
std::string direction_shown(const Vector<Dim>& v) {
  const auto [exact_plunge, trend] = plunge_and_trend(v);
  const double plunge = std::round(10 * exact_plunge) / 10 + 0.0;  // no "-0.0"
  if (Dim == 2 && std::abs(v[0]) <= rounding_of_directions * v.norm()) return plunge > 0 ? "down" : "up";
  return Dim == 3 ? fmt::format("{:.1f}/{:05.1f}", plunge, trend)
                  : fmt::format("{:.1f} {}", plunge, trend < 180 ? "right" : "left");
}

template <int Dim>
std::string force_shown(const SurveyRow<Dim>& row, const char* unit) {
  if (!row.force) return "not by a force";
  const double size = row.force->force.norm();
  if (size == 0) return "none";
  return fmt::format("{:.4g}{} ({}{})", size / 1000, unit, direction_shown<Dim>(row.force->force),
                     row.force->least ? "" : ", sufficient");
}

template <int Dim>
std::string verdict_remarks(const Survey<Dim>& survey, const SurveyRow<Dim>& row) {
  std::vector<std::string> all;
  const std::string motion = motion_of(row);
  if (motion != "slides" && !motion.empty())
    all.push_back(row.factor_moments && *row.factor_moments < row.bolted.factor.value_or(0)
                      ? fmt::format("{}: at most {:.4g} with moments", motion, *row.factor_moments)
                      : motion);
  else if (row.eccentricity && *row.eccentricity >= near_edge)
    all.push_back("near toppling");
  if (row.cluster > 0) all.push_back("lower than its blocks");
  if (!row.bolts.empty()) all.push_back(fmt::format("bolts {}", fmt::join(row.bolts, ", ")));
  if (row.bolted.verdict.indeterminate) all.push_back("indeterminate");
  if (!row.closed_faces.empty()) {
    std::vector<std::string> names;
    for (const int face : row.closed_faces)
      names.push_back(survey.joint_name(row.faces[face]));
    all.push_back(fmt::format("elastic shear closes {}", fmt::join(names, ", ")));
  }
  return fmt::format("{}", fmt::join(all, "; "));
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                    \
  template std::string kind_label<Dim>(const SurveyRow<Dim>&);                       \
  template std::string joints_shown<Dim>(const Survey<Dim>&, const SurveyRow<Dim>&); \
  template std::string direction_shown<Dim>(const Vector<Dim>&);                     \
  template std::string force_shown<Dim>(const SurveyRow<Dim>&, const char*);         \
  template std::string verdict_remarks<Dim>(const Survey<Dim>&, const SurveyRow<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
