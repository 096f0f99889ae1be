#include "app/report/joints_data.hpp"

#include <cmath>

namespace voussoir {

nlohmann::ordered_json short_normals(const std::vector<std::vector<double>>& normals) {
  constexpr double decimals = 1e7;
  auto rounded = nlohmann::ordered_json::array();
  for (const std::vector<double>& normal : normals) {
    auto& row = rounded.emplace_back(nlohmann::ordered_json::array());
    for (const double x : normal)
      row.push_back(std::round(x * decimals) / decimals);
  }
  return rounded;
}

std::string json_text(const nlohmann::ordered_json& data) {
  return data.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace voussoir
