// Words of a text file with their places.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "text/file_fault.hpp"

namespace voussoir {

// Whether a text has two bytes a character, as some editors save it: by its mark, or by its zeros. No reader here
// accepts it.
bool is_utf_16(std::string_view text);
inline constexpr const char* save_as_utf_8 =
    "is written in UTF-16; save it as UTF-8 (in an editor: save as, encoding UTF-8)";

struct Word {
  std::string_view text;
  int line = 0, column = 0;
};

// The lines of a text one after the other, ended by LF, CR LF or the end of the text; a byte order mark is skipped.
class LineReader {
 public:
  explicit LineReader(std::string_view text);

  // false at the end; refuses text that is not plain (text/plain_text.hpp), except for tabs
  bool next();
  std::string_view line() const { return line_; }
  int number() const { return number_; }  // from 1; of the last line once the end is reached

 private:
  std::string_view left_, line_;
  int number_ = 0;
};

// the words of a line, between blanks and tabs; refuses more than 1000
std::vector<Word> words_of(std::string_view line, int number);

// A finite decimal number that is the entire word; `what` names it in the reason.
double number_of(const Word& word, const std::string& what);

// at most about 40 characters of a text, on one line, in quotes
std::string shown(std::string_view text);

}  // namespace voussoir
