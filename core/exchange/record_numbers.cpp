#include "core/exchange/record_numbers.hpp"

#include <charconv>
#include <cmath>

#include "text/file_fault.hpp"
#include "text/text_scan.hpp"

namespace voussoir {
namespace {

bool is_digit(char character) {
  return character >= '0' && character <= '9';
}

std::size_t digits_at(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && is_digit(text[end]))
    ++end;
  return end - at;
}

bool is_one_of(char character, std::string_view all) {
  return all.find(character) != std::string_view::npos;
}

}  // namespace

std::size_t record_number_length(std::string_view text) {
  std::size_t at = !text.empty() && is_one_of(text[0], "+-") ? 1 : 0;
  std::size_t digits = digits_at(text, at);
  at += digits;
  if (at < text.size() && text[at] == '.') {
    const std::size_t decimals = digits_at(text, at + 1);
    digits += decimals;
    at += 1 + decimals;
  }
  if (digits == 0) return 0;
  if (at < text.size() && is_one_of(text[at], "eEdD")) {
    std::size_t exponent = at + 1;
    if (exponent < text.size() && is_one_of(text[exponent], "+-")) ++exponent;
    if (const std::size_t more = digits_at(text, exponent); more > 0) at = exponent + more;
  }
  return at;
}

double record_number(std::string_view number, int line, int column) {
  std::string text(number.starts_with('+') ? number.substr(1) : number);
  for (char& character : text)
    if (is_one_of(character, "dD")) character = 'e';
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range && text.find("e-") != std::string::npos) return 0;
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    throw FileFault(line, column, no_record_number(number));
  return value;
}

std::string no_record_number(std::string_view word) {
  return shown(word) + " is no finite number; correct it, or leave out the values from there on";
}

void add_record_numbers(std::string_view line, int number, std::vector<double>& values) {
  constexpr std::string_view between = " \t,";
  std::size_t at = 0;
  while ((at = line.find_first_not_of(between, at)) != std::string_view::npos) {
    const std::size_t length = record_number_length(line.substr(at));
    const int column = static_cast<int>(at) + 1;
    if (length == 0) {
      const std::size_t end = std::min(line.find_first_of(between, at), line.size());
      throw FileFault(number, column, no_record_number(line.substr(at, end - at)));
    }
    values.push_back(record_number(line.substr(at, length), number, column));
    at += length;
  }
}

}  // namespace voussoir
