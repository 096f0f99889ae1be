// The lines that `voussoir check` prints.
#pragma once

#include <fmt/format.h>

#include <string>

namespace voussoir {

// one labelled line; only the first line of a group has its label
inline void print_line(const char* label, const std::string& text) {
  fmt::print("  {:<12}{}\n", label, text);
}

}  // namespace voussoir
