// What is wrong with a scene, in one line: file, line, key, the value found, what is allowed, the repair.
#pragma once

#include <stdexcept>

namespace voussoir {

class SceneError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace voussoir
