// The slope of the plane failure: its geometry, and the override for the water in its crack.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "app/limit/limit_analysis.hpp"
#include "cases/case_tools.hpp"
#include "reference/water/wet_slopes.hpp"
#include "text/angle.hpp"

namespace voussoir::cases {

inline double limit_answer(const std::string& scene, const std::vector<std::string>& overrides,
                           const LimitRequest& request = {.with_dilation = true}) {
  const LimitAnalysis<2> found =
      analyse_limit<2>(load_scene(std::filesystem::path(VOUSSOIR_CASE_DIR) / scene, overrides), request);
  if (found.status != LimitStatus::found) throw std::runtime_error(scene + ": " + found.message);
  return found.values.front().second.value;
}

// as scene.toml states it; water fills the crack to a fraction of its depth
inline reference::PlaneFailure plane_failure(double fill) {
  reference::PlaneFailure slope{20, 60 * degree, 35 * degree, 4, 26e3, 0, 30e3, 40 * degree};
  slope.water_in_crack = fill * forces_of(slope).crack_depth;
  return slope;
}

inline std::string table_of(const reference::PlaneFailure& slope) {
  const double back = slope.height / std::tan(slope.face) + slope.crack_distance;
  return fmt::format("water.crack and joint.table=[[0, 0], [{:.17g}, {:.17g}]]", back,
                     back * std::tan(slope.joint) + slope.water_in_crack);
}

inline std::string filled(double fill) {
  return fill == 0 ? ", crack empty" : fill == 1 ? ", crack full" : ", crack half full";
}

// the water table is below the whole joint
inline const std::string empty_crack = "water.crack and joint.table=[[0, -90], [1, -90]]";

inline const std::string plane_source = "Hoek & Bray (1981), plane failure with a tension crack";

}  // namespace voussoir::cases
