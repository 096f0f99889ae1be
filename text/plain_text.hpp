// Text that is accepted and shown: valid UTF-8 without characters that control a terminal or change the order of
// reading. Every text from outside is checked when it is read, and characters that still pass are replaced when they
// are shown.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace voussoir {

// the first byte that is no plain text, and its kind, e.g. "a control character (U+001B)"
struct TextFault {
  std::size_t at = 0;
  std::string what;
};

// Refused are bytes that are no UTF-8 (RFC 3629), control characters (C0, DEL, C1), line and paragraph separators,
// marks that turn the direction of text, and noncharacters, which XML forbids. Tabs pass if a file may have them.
std::optional<TextFault> text_fault(std::string_view text, bool tabs_pass = false);

// the same text with a blank for every C0 character and U+FFFD for any other character that is no plain text
std::string printable(std::string_view text);

// printable, and cut behind about `limit` bytes
std::string one_line(std::string_view text, std::size_t limit);

}  // namespace voussoir
