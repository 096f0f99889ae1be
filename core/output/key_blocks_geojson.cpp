#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "core/geometry/plunge_trend.hpp"
#include "core/output/block_verdicts.hpp"

namespace voussoir {
namespace {

using Json = nlohmann::ordered_json;
using PlanPoint = std::array<double, 2>;  // m, east and north

// counter-clockwise and closed (Andrew's monotone chain)
std::vector<PlanPoint> outline_of(std::vector<PlanPoint> points) {
  std::ranges::sort(points);
  const auto turns_left = [](const PlanPoint& a, const PlanPoint& b, const PlanPoint& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0;
  };
  std::vector<PlanPoint> ring;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = ring.size();
    for (const PlanPoint& point : points) {
      while (ring.size() >= first + 2 && !turns_left(ring[ring.size() - 2], ring.back(), point))
        ring.pop_back();
      ring.push_back(point);
    }
    ring.pop_back();
    std::ranges::reverse(points);
  }
  ring.push_back(ring.front());
  return ring;
}

Json feature_of(const Survey<3>& survey, const SurveyRow<3>& row, std::vector<PlanPoint> corners) {
  const auto [plunge, trend] = plunge_and_trend(row.bolted.verdict.direction());
  Json properties = {{"blocks", survey.body_names(row)},
                     {"cluster", row.cluster > 0 ? Json(row.cluster) : Json()},
                     {"verdict", word_of(row.kind())},
                     {"joints", loaded_joints(survey, row)},
                     {"volume_m3", row.volume},
                     {"weight_N", row.weight},
                     {"plunge_deg", plunge},
                     {"trend_deg", trend},
                     {"factor", *row.bolted.factor},
                     {"required", survey.request.required},
                     {"force_N", row.force ? Json(row.force->force.norm()) : Json()}};
  return {{"type", "Feature"},
          {"geometry", {{"type", "Polygon"}, {"coordinates", Json::array({outline_of(std::move(corners))})}}},
          {"properties", std::move(properties)}};
}

}  // namespace

std::string key_blocks_geojson(const Survey<3>& survey, const PolyData& faces) {
  const auto body = std::ranges::find(faces.cell_data, "body", &DataArray::name);
  std::vector<std::vector<PlanPoint>> corners(survey.assembly.model.bodies.size());
  for (std::size_t c = 0; c < faces.cells.size(); ++c)
    for (const int p : faces.cells[c])
      corners[static_cast<std::size_t>(body->values[c])].push_back({faces.points[p][0], faces.points[p][1]});
  Json features = Json::array();
  for (const auto* list : {&survey.rows, &survey.clusters})
    for (const SurveyRow<3>& row : *list) {
      if (!is_key(survey, row)) continue;
      std::vector<PlanPoint> all;
      for (const int b : row.bodies)
        all.insert(all.end(), corners[b].begin(), corners[b].end());
      features.push_back(feature_of(survey, row, std::move(all)));
    }
  const Json map = {{"type", "FeatureCollection"}, {"name", "key blocks"}, {"features", std::move(features)}};
  return map.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace voussoir
