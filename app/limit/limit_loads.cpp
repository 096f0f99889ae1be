#include "app/limit/limit_loads.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

namespace voussoir {
namespace {

// numbers parted by commas and nothing else
std::optional<std::vector<double>> numbers_of(const std::string& text) {
  std::vector<double> numbers;
  const char *at = text.data(), *const end = text.data() + text.size();
  while (true) {
    double number = 0;
    const auto [after, error] = std::from_chars(at, end, number);
    if (error != std::errc() || !std::isfinite(number)) return {};
    numbers.push_back(number);
    if (after == end) return numbers;
    if (*after != ',') return {};
    at = after + 1;
  }
}

}  // namespace

const char* const limit_load_rule =
    "must be \"gravity\", \"applied\", \"left\", \"right\", \"east\", \"west\", \"north\", \"south\", \"up\", "
    "\"down\", "
    "or a direction such as \"1,0,-0.5\" (two numbers in the plane, three in space)";

std::optional<LimitLoad> limit_load(const std::string& text) {
  using Kind = LimitLoad::Kind;
  if (text == "gravity") return LimitLoad{Kind::gravity, text, {}};
  if (text == "applied") return LimitLoad{Kind::applied, text, {}};
  static const std::array<std::pair<const char*, std::vector<double>>, 8> named{{{"left", {-1, 0}},
                                                                                 {"right", {1, 0}},
                                                                                 {"east", {1, 0, 0}},
                                                                                 {"west", {-1, 0, 0}},
                                                                                 {"north", {0, 1, 0}},
                                                                                 {"south", {0, -1, 0}},
                                                                                 {"up", {0, 0, 1}},
                                                                                 {"down", {0, 0, -1}}}};
  for (const auto& [name, direction] : named)
    if (text == name) return LimitLoad{Kind::acceleration, text, direction};
  std::optional<std::vector<double>> direction = numbers_of(text);
  if (!direction || (direction->size() != 2 && direction->size() != 3)) return {};
  Eigen::Map<Eigen::VectorXd> vector(direction->data(), static_cast<Eigen::Index>(direction->size()));
  const double largest = vector.cwiseAbs().maxCoeff();
  if (!(largest > 0)) return {};
  vector /= largest;
  vector.normalize();
  return LimitLoad{Kind::acceleration, text, std::move(*direction)};
}

}  // namespace voussoir
