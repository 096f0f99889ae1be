// What is wrong with a scene, in one line: file, line, key, the value found, what is allowed, the repair.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace voussoir {

struct SceneError : std::runtime_error {
  explicit SceneError(const std::string& message, std::string in_file = {}, int at_line = 0, std::string of_key = {})
      : std::runtime_error(message), file(std::move(in_file)), line(at_line), key(std::move(of_key)) {}

  // what the message says besides, where it says it
  std::string file;
  int line = 0;     // 0: none
  std::string key;  // its address, e.g. joints.A.dip
};

}  // namespace voussoir
