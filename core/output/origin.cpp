#include "core/output/origin.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/base/fingerprint.hpp"
#include "core/output/json_parts.hpp"

namespace voussoir {
namespace {

// On x86-64 glibc's functions with and without fused multiply-adds differ in about one value of a thousand: with this
// number of values of a dozen functions no two libraries agree.
constexpr int values_of_each = 2000;

using Function = double (*)(double);

// arguments in (0, 1) mapped to the range in which each function is used, without overflow or leaving its domain
constexpr Function functions[] = {
    [](double u) { return std::sin(200 * u - 100); },
    [](double u) { return std::cos(200 * u - 100); },
    [](double u) { return std::tan(200 * u - 100); },
    [](double u) { return std::asin(2 * u - 1); },
    [](double u) { return std::acos(2 * u - 1); },
    [](double u) { return std::atan(4 * u - 2); },
    [](double u) { return std::atan2(u - 0.4, 0.7 - u * u); },
    [](double u) { return std::exp(40 * u - 30); },
    [](double u) { return std::expm1(u - 0.5); },
    [](double u) { return std::log(2 * u + 0.1); },
    [](double u) { return std::log1p(2 * u - 0.9); },
    [](double u) { return std::log2(2 * u + 0.1); },
    [](double u) { return std::log10(2 * u + 0.1); },
    [](double u) { return std::pow(10 * u + 1e-3, 3 * u - 1); },
    [](double u) { return std::cbrt(10 * u); },
    [](double u) { return std::hypot(u, 1 - u * u); },
};

std::string hash_of_values() {
  std::string bytes;
  bytes.reserve(std::size(functions) * values_of_each * sizeof(double));
  for (const Function function : functions) {
    double u = 0.5;
    for (int k = 0; k < values_of_each; ++k) {
      u += 0.6180339887498949;  // the golden section spreads them evenly
      if (u >= 1) u -= 1;
      const double value = function(u);
      bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
  }
  return fingerprint(bytes);
}

}  // namespace

const std::string& math_functions_hash() {
  static const std::string hash = hash_of_values();
  return hash;
}

bool add_origin(std::vector<Origin>& origins, const Origin& origin) {
  if (std::find(origins.begin(), origins.end(), origin) != origins.end()) return false;
  origins.push_back(origin);
  return true;
}

nlohmann::ordered_json origins_json(const std::vector<Origin>& origins) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const Origin& origin : origins)
    json.push_back({{"program_hash", origin.program},
                    {"math_functions", origin.math_functions},
                    {"portable_math", origin.portable_math}});
  return json;
}

std::vector<Origin> origins_of(const nlohmann::json& json) {
  std::vector<Origin> origins;
  for (const nlohmann::json& origin : json)
    origins.push_back({origin.at("program_hash"), origin.at("math_functions"), origin.at("portable_math")});
  return origins;
}

}  // namespace voussoir
