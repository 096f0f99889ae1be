#include "text/plain_text.hpp"

#include <fmt/format.h>

namespace voussoir {
namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";  // U+FFFD

struct Character {
  char32_t code = 0;
  std::size_t length = 1;  // bytes; if it is no UTF-8, the one at which a character must begin
  bool valid = false;
};

// the character at the begin of a text that is not empty; overlong forms, surrogates and codes beyond U+10FFFF are no
// UTF-8
Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return {lead, 1, true};
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < length) return {lead, 1, false};
  char32_t code = lead & (0xFFu >> (length + 1));
  for (std::size_t k = 1; k < length; ++k) {
    if ((byte(k) & 0xC0) != 0x80) return {lead, 1, false};
    code = code << 6 | (byte(k) & 0x3Fu);
  }
  constexpr char32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < least[length] || code > 0x10FFFF || surrogate) return {lead, 1, false};
  return {code, length, true};
}

bool turns_direction(char32_t c) {
  return c == 0x061C || c == 0x200E || c == 0x200F || (c >= 0x202A && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069);
}

// the kind of a character that is no plain text; empty for all others
std::string_view kind_of_fault(char32_t c) {
  if (c < 0x20 || (c >= 0x7F && c <= 0x9F)) return "a control character";
  if (c == 0x2028 || c == 0x2029) return "a line separator";
  if (turns_direction(c)) return "a mark that turns the direction of text";
  if (c == 0xFEFF) return "a byte order mark within the text";
  if ((c & 0xFFFE) == 0xFFFE || (c >= 0xFDD0 && c <= 0xFDEF)) return "a code that is no character";
  return {};
}

// the next place from `at` on that needs a check: everything else is printable ASCII
std::size_t skip_ascii(std::string_view text, std::size_t at) {
  while (at < text.size() && text[at] >= 0x20 && text[at] < 0x7F)
    ++at;
  return at;
}

}  // namespace

std::optional<TextFault> text_fault(std::string_view text, bool tabs_pass) {
  for (std::size_t at = skip_ascii(text, 0); at < text.size(); at = skip_ascii(text, at)) {
    const Character c = first_character(text.substr(at));
    if (!c.valid) return TextFault{at, fmt::format("the byte 0x{:02X}, which is not UTF-8", static_cast<int>(c.code))};
    const std::string_view kind = kind_of_fault(c.code);
    if (!kind.empty() && !(tabs_pass && c.code == '\t'))
      return TextFault{at, fmt::format("{} (U+{:04X})", kind, static_cast<int>(c.code))};
    at += c.length;
  }
  return std::nullopt;
}

std::string one_line(std::string_view text, std::size_t limit) {
  std::string line;
  for (std::size_t at = 0; at < text.size();) {
    if (line.size() >= limit) return line + "…";
    const Character c = first_character(text.substr(at));
    if (c.valid && kind_of_fault(c.code).empty())
      line += text.substr(at, c.length);
    else
      line += c.valid && c.code < 0x20 ? std::string_view(" ") : replacement;
    at += c.length;
  }
  return line;
}

std::string printable(std::string_view text) {
  return one_line(text, std::string_view::npos);
}

}  // namespace voussoir
