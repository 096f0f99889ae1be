#include "core/output/results.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace voussoir {

std::string divided_by_factor(const std::vector<std::string>& properties, bool cohesion) {
  const std::string joints = properties.empty() ? "all joints" : fmt::format("'{}'", fmt::join(properties, "', '"));
  return fmt::format("divides tan φ{} of {}; not {}tensile strength, bolts, linings' beams or water",
                     cohesion ? " and cohesion" : "", joints, cohesion ? "" : "cohesion, which is left out, ");
}

}  // namespace voussoir
