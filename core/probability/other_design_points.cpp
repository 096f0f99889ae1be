#include "core/probability/other_design_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>

#include "core/joint_sets/random_stream.hpp"
#include "core/probability/nearest_point.hpp"
#include "core/probability/normal.hpp"

namespace voussoir {
namespace {

constexpr double apart = 0.3;       // of β: a point nearer to another is the same
constexpr double rare = 1e-3;       // of the others' probability: a rarer one does not count
constexpr double tried_near = 0.5;  // in u: no start so near to an earlier one

struct PointHunt {
  const LimitFunction& limit;
  const OtherPointsRequest& request;
  OtherPoints& found;
  std::vector<PilotRow> failed;  // the nearest first
  std::vector<StandardPoint> tried;
  std::set<std::string> tried_modes, ends_at_known;  // from whose failed rows the search ended at a known point

  void ask_pilots() {
    const DesignPoint& first = found.points.front();
    const double keys = static_cast<double>(first.u.size());
    const double spread = std::max(1.0, (std::abs(first.beta) + 1) / std::sqrt(keys));
    std::vector<StandardPoint> rows;
    for (int k = 0; k < request.pilots; ++k) {
      RandomStream stream(request.seed, fmt::format("pilot row {}", k));
      rows.emplace_back(first.u.size());
      for (double& part : rows.back())
        part = spread * stream.normal();
    }
    const std::vector<StateAnswer> answers = (request.failed ? request.failed : limit)(rows);
    found.pilots = request.pilots;
    found.evaluations += request.pilots;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      found.history.push_back({std::move(rows[k]), answers[k]});
      if (answers[k].g && *answers[k].g <= 0) failed.push_back(found.history.back());
    }
    std::ranges::stable_sort(failed, {}, [](const PilotRow& row) { return length(row.u); });
  }

  bool is_explained(const StandardPoint& u) const {
    return std::ranges::any_of(found.points, [&](const DesignPoint& point) {
      const double away = length(point.u);
      return dot(point.u, u) >= away * away;
    });
  }

  bool is_tried(const StandardPoint& u) const {
    return std::ranges::any_of(tried, [&](const StandardPoint& other) { return distance(u, other) <= tried_near; });
  }

  bool has_point(const std::string& mode) const {
    return std::ranges::any_of(found.points, [&](const DesignPoint& point) { return point.mode == mode; });
  }

  // a row that no half-space explains, else one of a mode without a point
  const PilotRow* next_start() {
    for (const PilotRow& row : failed)
      if (!is_explained(row.u) && !is_tried(row.u)) return &row;
    for (const PilotRow& row : failed)
      if (const std::string& mode = row.answer.mode;
          !mode.empty() && !has_point(mode) && tried_modes.insert(mode).second)
        return &row;
    return nullptr;
  }

  bool is_new(const DesignPoint& point) const {
    return std::ranges::all_of(found.points, [&](const DesignPoint& other) {
      return distance(point.u, other.u) > apart * length(other.u) &&
             normal_probability(-length(point.u)) > rare * normal_probability(-length(other.u));
    });
  }

  void search_from(const PilotRow& row) {
    ++found.starts;
    tried.push_back(row.u);
    tried_modes.insert(row.answer.mode);
    DesignPointRequest search = request.search;
    search.start = row.u;
    search.reversed = found.points.front().beta < 0;
    DesignPointSearch ended = find_design_point(limit, row.u.size(), search);
    found.evaluations += ended.evaluations;
    if (!ended.found)
      ++found.lost;
    else if (is_new(*ended.found))
      found.points.push_back(*std::move(ended.found));
    else
      ends_at_known.insert(row.answer.mode);
  }
};

}  // namespace

OtherPoints find_other_design_points(const LimitFunction& limit, const DesignPoint& first,
                                     const OtherPointsRequest& request) {
  OtherPoints found;
  found.points.push_back(first);
  PointHunt hunt{limit, request, found, {}, {}, {}, {}};
  hunt.ask_pilots();
  for (const PilotRow* start = hunt.next_start(); start && found.starts < request.most_starts;
       start = hunt.next_start())
    hunt.search_from(*start);
  std::ranges::stable_sort(found.points, {}, [](const DesignPoint& point) { return length(point.u); });
  std::set<std::string> modes;
  for (const PilotRow& row : hunt.failed)
    if (!row.answer.mode.empty() && !hunt.has_point(row.answer.mode)) modes.insert(row.answer.mode);
  for (const std::string& mode : modes)
    (hunt.ends_at_known.contains(mode) ? found.modes_behind : found.modes_without).push_back(mode);
  return found;
}

}  // namespace voussoir
