// Results as text files.
#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace voussoir::benchmarks {

// makes the folder; throws std::runtime_error if the file cannot be written
inline void write_text(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream file(path);
  file << text;
  if (!file.flush()) throw std::runtime_error(path.string() + " cannot be written");
}

}  // namespace voussoir::benchmarks
