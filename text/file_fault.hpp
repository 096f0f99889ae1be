// What is wrong with a file that is read line by line, and where.
#pragma once

#include <stdexcept>
#include <string>

namespace voussoir {

// `what()` is the reason with its repair. Line and column count from 1, columns in bytes; 0: the file has no lines (a
// binary one), or the fault is the whole file's or line's.
struct FileFault : std::runtime_error {
  FileFault(int where_line, int where_column, const std::string& reason)
      : std::runtime_error(reason), line(where_line), column(where_column) {}
  int line, column;
};

// What the user should know about a file that is read: one line.
struct FileRemark {
  int line = 0;  // 0: of the whole file
  std::string text;
};

}  // namespace voussoir
