// `voussoir import`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/base/exit_codes.hpp"

namespace voussoir {

struct ImportArguments {
  std::filesystem::path file;
  std::string format;                     // facets, fab, dxf, traces
  std::filesystem::path out;              // a file
  std::vector<double> shift = {0, 0, 0};  // m, added to coordinates
  bool overwrite = false;
};

// joints of another program's file as a table that scenes read, and a report on stdout
ExitCode import_command(const ImportArguments& arguments);

}  // namespace voussoir
