// Words of a text file with their places.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/exchange/file_fault.hpp"

namespace voussoir {

struct Word {
  std::string_view text;
  int line = 0, column = 0;
};

// The lines of a text one after the other, ended by LF, CR LF or the end of the text; a byte order mark is skipped.
class LineReader {
 public:
  explicit LineReader(std::string_view text);

  // false at the end; refuses control characters, which tell of a binary file
  bool next();
  std::string_view line() const { return line_; }
  int number() const { return number_; }  // from 1; of the last line once the end is reached

 private:
  std::string_view left_, line_;
  int number_ = 0;
};

// the words of a line, between blanks and tabs; refuses more than 1000
std::vector<Word> words_of(std::string_view line, int number);

// A finite decimal number that is the whole word; `what` names it in the reason.
double number_of(const Word& word, const std::string& what);

// at most about 40 characters of a text, on one line, in quotes
std::string shown(std::string_view text);

}  // namespace voussoir
