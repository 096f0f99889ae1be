// The wedge's scene, for any two joints.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "reference/wedge/wedge.hpp"
#include "text/angle.hpp"

namespace voussoir::cases {

inline reference::Wedge wedge(double dip_a, double direction_a, double dip_b, double direction_b) {
  reference::Wedge w;
  w.a.dip = dip_a * degree;
  w.a.dip_direction = direction_a * degree;
  w.b.dip = dip_b * degree;
  w.b.dip_direction = direction_b * degree;
  return w;
}

inline std::vector<std::string> overrides(const reference::Wedge& w) {
  const reference::WedgeSolution solution = reference::solve_wedge(w);
  // in a face that dips steeply along the line of intersection the line daylights
  const double dip = std::min(85.0, solution.line_plunge / degree + 30);
  return {fmt::format("joints.A.dip={:.17g}", w.a.dip / degree),
          fmt::format("joints.A.dip_direction={:.17g}", w.a.dip_direction / degree),
          fmt::format("joints.B.dip={:.17g}", w.b.dip / degree),
          fmt::format("joints.B.dip_direction={:.17g}", w.b.dip_direction / degree),
          fmt::format("domain.planes.slope face.dip={:.17g}", dip),
          fmt::format("domain.planes.slope face.dip_direction={:.17g}", solution.line_trend / degree)};
}

}  // namespace voussoir::cases
