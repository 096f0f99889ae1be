#include "verification/comparison/comparison.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace voussoir::verification {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr std::array kind_names{std::pair{Kind::exact, "exact"}, std::pair{Kind::limit, "limit"},
                                std::pair{Kind::published, "published"}, std::pair{Kind::drift, "drift"},
                                std::pair{Kind::reported, "reported"}};
constexpr std::array bound_names{std::pair{Bound::both, "both"}, std::pair{Bound::at_most, "at_most"},
                                 std::pair{Bound::at_least, "at_least"}};

template <class Names, class Value>
std::string_view look_up_name(const Names& names, Value value) {
  for (const auto& [known, name] : names)
    if (known == value) return name;
  throw std::invalid_argument("a value outside its enum");
}

template <class Names>
auto look_up_value(const Names& names, std::string_view wanted) {
  for (const auto& [value, name] : names)
    if (name == wanted) return value;
  throw std::invalid_argument(fmt::format("'{}' is not a known name", wanted));
}

// signed distance beyond the expected value, in the direction that the bound forbids
double excess(double computed, double expected, Bound bound) {
  const double error = computed - expected;
  if (bound == Bound::at_most) return error;
  if (bound == Bound::at_least) return -error;
  return std::abs(error);
}

void require(bool condition, const Check& check, std::string_view problem) {
  if (!condition) throw std::invalid_argument(fmt::format("check '{}': {}", check.quantity, problem));
}

}  // namespace

double width(double expected, const Tolerance& tolerance) {
  return tolerance.absolute + tolerance.relative * std::abs(expected);
}

bool within(double computed, double expected, const Tolerance& tolerance) {
  // test for finiteness first: a comparison with NaN would be false here, but true once negated elsewhere
  if (!std::isfinite(computed) || !std::isfinite(expected)) return false;
  return excess(computed, expected, tolerance.bound) <= width(expected, tolerance);
}

bool bites(const Check& check) {
  const double half = width(check.expected, check.tolerance);

  // a tolerance of zero requires the very same number: then the nearest other number must be refused
  const double above = half > 0.0 ? check.expected + 3.0 * half : std::nextafter(check.expected, infinity);
  const double below = half > 0.0 ? check.expected - 3.0 * half : std::nextafter(check.expected, -infinity);
  const bool refuses_above = !within(above, check.expected, check.tolerance);
  const bool refuses_below = !within(below, check.expected, check.tolerance);
  if (check.tolerance.bound == Bound::at_most) return refuses_above;
  if (check.tolerance.bound == Bound::at_least) return refuses_below;
  return refuses_above && refuses_below;
}

double margin(double computed, const Check& check) {
  if (!std::isfinite(computed) || !std::isfinite(check.expected)) return infinity;
  const double beyond = excess(computed, check.expected, check.tolerance.bound);
  const double half = width(check.expected, check.tolerance);
  if (half > 0.0) return beyond / half;
  return beyond <= 0.0 ? 0.0 : infinity;
}

void require_complete(const Check& check) {
  require(!check.quantity.empty(), check, "has no quantity; name the compared quantity");
  require(!check.unit.empty(), check, "has no unit; write \"1\" for a number without dimension");
  require(!check.source.empty(), check, "has no source; name author, year and equation, or the identity");
  require(!check.because.empty(), check, "has no because; state the derivation of the tolerance");
  require(check.kind != Kind::reported, check, "has kind reported; use report() for a number without a target");
  require(std::isfinite(check.expected), check, "expects a number that is not finite");

  const Tolerance& tolerance = check.tolerance;
  require(std::isfinite(tolerance.absolute) && tolerance.absolute >= 0.0, check, "has a bad absolute tolerance");
  require(std::isfinite(tolerance.relative) && tolerance.relative >= 0.0, check, "has a bad relative tolerance");
  require(tolerance.relative < 1.0, check, "has a relative tolerance of 1 or more, which accepts zero");
  require(tolerance.bound == Bound::both || check.kind == Kind::limit, check,
          "has a one-sided bound, which only kind limit may have");
  require(bites(check), check, "cannot fail: its tolerance is lost in the rounding of the expected value");
}

std::string_view name_of(Kind kind) {
  return look_up_name(kind_names, kind);
}
std::string_view name_of(Bound bound) {
  return look_up_name(bound_names, bound);
}
Kind kind_of(std::string_view name) {
  return look_up_value(kind_names, name);
}
Bound bound_of(std::string_view name) {
  return look_up_value(bound_names, name);
}

}  // namespace voussoir::verification
