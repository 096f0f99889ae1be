#include "app/limit/limit_loads.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Core>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

namespace voussoir {
namespace {

using Kind = LimitLoad::Kind;

const std::vector<LimitLoad> named{{Kind::gravity, "gravity", {}},           {Kind::applied, "applied", {}},
                                   {Kind::acceleration, "left", {-1, 0}},    {Kind::acceleration, "right", {1, 0}},
                                   {Kind::acceleration, "east", {1, 0, 0}},  {Kind::acceleration, "west", {-1, 0, 0}},
                                   {Kind::acceleration, "north", {0, 1, 0}}, {Kind::acceleration, "south", {0, -1, 0}},
                                   {Kind::acceleration, "up", {0, 0, 1}},    {Kind::acceleration, "down", {0, 0, -1}}};

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

std::vector<std::string> named_limit_loads() {
  std::vector<std::string> names;
  for (const LimitLoad& load : named)
    names.push_back(load.name);
  return names;
}

std::string limit_load_rule() {
  return fmt::format("must be \"{}\", or a direction such as \"1,0,-0.5\" (two numbers in the plane, three in space)",
                     fmt::join(named_limit_loads(), "\", \""));
}

std::optional<LimitLoad> limit_load(const std::string& text) {
  if (const auto load = std::ranges::find(named, text, &LimitLoad::name); load != named.end()) return *load;
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
