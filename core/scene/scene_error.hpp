// An error of a scene, in one line: file, line, key, the value found, the allowed values, the repair.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace voussoir {

struct SceneError : std::runtime_error {
  explicit SceneError(const std::string& message, std::string in_file = {}, int at_line = 0, std::string of_key = {})
      : std::runtime_error(message), file(std::move(in_file)), line(at_line), key(std::move(of_key)) {}

  // parts of the message, if it has them
  std::string file;
  int line = 0;     // 0: none
  std::string key;  // its address, e.g. joints.A.dip
};

}  // namespace voussoir
