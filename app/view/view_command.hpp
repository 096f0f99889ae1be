// `voussoir view`.
#pragma once

#include <filesystem>
#include <string>

#include "app/base/exit_codes.hpp"

namespace voussoir {

struct ViewArguments {
  std::filesystem::path folder;
  std::filesystem::path out;     // empty: view.html in the folder
  bool fragment = false;         // for a page that holds the viewer once and many of these
  bool script = false;           // what such a page holds once; then no folder is read
  std::filesystem::path poster;  // a picture, PNG or WebP, to stand there until it is clicked; empty: none
  std::string look;              // what a fragment shows at first, as behind # in a page's address
  bool overwrite = false;
};

// the page in which the blocks of a run can be turned, from what the run has kept for it
ExitCode view_command(const ViewArguments& arguments);

}  // namespace voussoir
