// Lines for people on stderr. Where nobody can read them (a log on a full disk), the work and its exit code matter
// more: unlike fmt's print, this throws nothing of its own.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <utility>

namespace voussoir {

template <class... Values>
void tell(fmt::format_string<Values...> format, Values&&... values) {
  std::fputs(fmt::format(format, std::forward<Values>(values)...).c_str(), stderr);
}

}  // namespace voussoir
