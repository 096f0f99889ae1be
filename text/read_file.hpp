// A file in memory, complete or refused: no endless pipe or device, no file larger than permitted.
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace voussoir {

// `what()` is the reason with its repair and without the file's name
struct ReadFault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Throws ReadFault for a file that is missing, not regular, larger than `most` bytes, or unreadable.
std::string read_file(const std::filesystem::path& file, std::uintmax_t most);

// the same, but of a larger file the first `most` bytes; `size` becomes that of the entire file
std::string read_head(const std::filesystem::path& file, std::uintmax_t most, std::uintmax_t& size);

}  // namespace voussoir
