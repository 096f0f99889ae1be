// Plain vectors as Eigen's.
#pragma once

#include <Eigen/Dense>

#include "reference/wedge/wedge.hpp"

namespace voussoir::reference {

inline Eigen::Vector3d to_eigen(const Vector3& v) {
  return {v[0], v[1], v[2]};
}

}  // namespace voussoir::reference
