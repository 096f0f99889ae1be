#include "text/text_scan.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "text/plain_text.hpp"

namespace voussoir {

bool is_utf_16(std::string_view text) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) return true;
  return text.size() >= 4 && ((text[0] == 0) != (text[1] == 0)) && (text[0] == 0) == (text[2] == 0) &&
         (text[1] == 0) == (text[3] == 0);
}

LineReader::LineReader(std::string_view text) : left_(text) {
  if (left_.starts_with("\xEF\xBB\xBF")) left_.remove_prefix(3);
  if (is_utf_16(left_)) throw FileFault(1, 0, save_as_utf_8);
}

bool LineReader::next() {
  if (left_.empty()) return false;
  ++number_;
  const std::size_t end = left_.find('\n');
  line_ = left_.substr(0, end);
  left_.remove_prefix(end == std::string_view::npos ? left_.size() : end + 1);
  if (line_.ends_with('\r')) line_.remove_suffix(1);
  if (const auto fault = text_fault(line_, true))
    throw FileFault(number_, static_cast<int>(fault->at) + 1,
                    fault->what + "; save the file as plain text in UTF-8, if it is no file of another kind");
  return true;
}

std::vector<Word> words_of(std::string_view line, int number) {
  constexpr std::string_view blanks = " \t";
  constexpr std::size_t most_words = 1000;  // a face has some ten corners
  std::vector<Word> words;
  std::size_t at = 0;
  while ((at = line.find_first_not_of(blanks, at)) != std::string_view::npos) {
    if (words.size() == most_words)
      throw FileFault(number, static_cast<int>(at) + 1,
                      "more than " + std::to_string(most_words) + " words in a line; is this a file of another kind?");
    const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
    words.push_back({line.substr(at, end - at), number, static_cast<int>(at) + 1});
    at = end;
  }
  return words;
}

double number_of(const Word& word, const std::string& what) {
  double number = 0;
  const char* end = word.text.data() + word.text.size();
  const auto [stop, error] = std::from_chars(word.text.data(), end, number);
  if (error != std::errc() || stop != end || !std::isfinite(number))
    throw FileFault(word.line, word.column,
                    what + " = " + shown(word.text) + ": must be a finite decimal number, for example 12.5 or -3e2" +
                        (word.text.find(',') == std::string_view::npos ? "" : "; write the decimals with a point"));
  return number;
}

std::string shown(std::string_view text) {
  constexpr std::size_t longest = 40;
  return "'" + one_line(text, longest) + "'";
}

}  // namespace voussoir
