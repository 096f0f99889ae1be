// Orientations for reports: the mean of a set's joints.
#pragma once

#include <optional>
#include <vector>

#include "app/base/dip_angles.hpp"

namespace voussoir {

struct MeanOrientation {
  DipAndDirection angles{0, 0};
  std::optional<double> fisher_constant;  // 3-D; nothing if the normals do not scatter
};

// Of unit normals that have no sign: the axis of their largest moment. Fisher's constant is that of the normals turned
// to its side, (n - 1)/(n - |sum|) (Fisher 1953). At least one normal.
template <int Dim>
MeanOrientation mean_orientation(const std::vector<Vector<Dim>>& normals);

}  // namespace voussoir
