// Lines for people on stderr. If they cannot be written (a log on a full disk), the work and its exit code matter
// more: unlike fmt's print, this throws nothing of its own. Control characters are replaced
// (text/plain_text.hpp).
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "text/plain_text.hpp"

namespace voussoir {

// one line, with its end
template <class... Values>
void tell(fmt::format_string<Values...> format, Values&&... values) {
  std::string line = fmt::format(format, std::forward<Values>(values)...);
  if (line.ends_with('\n')) line.pop_back();
  std::fputs((printable(line) + "\n").c_str(), stderr);
}

inline void tell_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings)
    tell("voussoir: warning: {}\n", warning);
}

// replaces the line that the cursor of a terminal is in
inline void rewrite_line(const std::string& line) {
  std::fputs(("\r\033[K" + printable(line)).c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace voussoir
