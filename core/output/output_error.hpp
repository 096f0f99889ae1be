// A result that could not be written: names the path and the reason. The kind decides the program's exit code.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace voussoir {

struct OutputError : std::runtime_error {
  enum class Kind {
    failed,        // a write, flush or rename that went wrong
    disk_full,     // or a quota or a limit on the file's size
    not_permitted  // a folder or file without permission to write
  };

  OutputError(const std::filesystem::path& path, const std::string& reason, Kind why = Kind::failed)
      : std::runtime_error("cannot write '" + path.string() + "': " + reason), kind(why) {}

  Kind kind;
};

// from errno
OutputError output_error(const std::filesystem::path& path, int error_number);

}  // namespace voussoir
