// Which text is taken and shown: valid UTF-8 without characters that steer a terminal or change the order of what is
// read. Whatever comes from outside is held against it where it enters, and what could still slip through is replaced
// where it is shown.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace voussoir {

// the first byte of what is no plain text, and what it is, e.g. "a control character (U+001B)"
struct TextFault {
  std::size_t at = 0;
  std::string what;
};

// Refused are bytes that are no UTF-8 (RFC 3629), control characters (C0, DEL, C1), line and paragraph separators,
// marks that turn the direction of text, and noncharacters, which XML forbids. Tabs pass where a file may hold them.
std::optional<TextFault> text_fault(std::string_view text, bool tabs_pass = false);

// the same text with a blank for every C0 character and U+FFFD for whatever else is no plain text
std::string printable(std::string_view text);

// printable, and cut behind about `limit` bytes
std::string one_line(std::string_view text, std::size_t limit);

}  // namespace voussoir
