// The input hash of a scene: the fingerprint of its canonical form, which layout and comments do not change.
#pragma once

#include <string>

#include "core/scene/scene.hpp"

namespace voussoir {

std::string input_hash(const Scene& scene);

}  // namespace voussoir
