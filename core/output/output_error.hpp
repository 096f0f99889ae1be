// A result that could not be written: names the path and the reason; the program ends with exit code 5.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace voussoir {

struct OutputError : std::runtime_error {
  OutputError(const std::filesystem::path& path, const std::string& reason)
      : std::runtime_error("cannot write '" + path.string() + "': " + reason) {}
};

}  // namespace voussoir
