#include "reports/equation_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <regex>
#include <sstream>

#include "verification/verdict_file.hpp"

namespace voussoir::reports {
namespace {

namespace fs = std::filesystem;

bool is_letter_or_digit(char c) {
  return std::isalnum(static_cast<unsigned char>(c));
}
bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c));
}

// a number of an equation
struct Number {
  char chapter;
  int count;
  std::string text() const { return fmt::format("{}.{}", chapter, count); }
};

// takes a word from the front of a text, if it begins with it
bool take(std::string_view& text, std::string_view word) {
  if (!text.starts_with(word)) return false;
  text.remove_prefix(word.size());
  return true;
}

std::optional<Number> take_number(std::string_view& text) {
  if (text.size() < 3 || !(is_digit(text[0]) || (text[0] >= 'A' && text[0] <= 'I')) || text[1] != '.') return {};
  std::size_t end = 2;
  while (end < text.size() && is_digit(text[end]) && end < 5)
    ++end;
  if (end == 2 || (end < text.size() && is_letter_or_digit(text[end]))) return {};
  const Number number{text[0], std::stoi(std::string(text.substr(2, end - 2)))};
  text.remove_prefix(end);
  return number;
}

// one number or a range; nothing is taken when there is none
bool take_item(std::string_view& text, std::vector<std::string>& numbers) {
  const auto first = take_number(text);
  if (!first) return false;
  numbers.push_back(first->text());
  std::string_view rest = text;
  if (!take(rest, "-") && !take(rest, "–")) return true;
  const auto last = take_number(rest);
  if (!last || last->chapter != first->chapter) return true;
  for (int count = first->count + 1; count <= last->count; ++count)
    numbers.push_back(Number{first->chapter, count}.text());
  text = rest;
  return true;
}

}  // namespace

std::vector<std::string> equations_named(std::string_view text) {
  std::vector<std::string> numbers;
  for (std::size_t at; (at = text.find("Eq")) != std::string_view::npos;) {
    const bool begins_a_word = at == 0 || !is_letter_or_digit(text[at - 1]);
    text.remove_prefix(at);
    if (begins_a_word && take(text, "Eqs ")) {
      bool more = take_item(text, numbers);
      while (more) {
        std::string_view rest = text;
        more = (take(rest, ", and ") || take(rest, ", ") || take(rest, " and ")) && take_item(rest, numbers);
        if (more) text = rest;
      }
    } else if (begins_a_word && take(text, "Eq. ")) {
      if (const auto number = take_number(text)) numbers.push_back(number->text());
    } else {
      text.remove_prefix(2);
    }
  }
  return numbers;
}

std::vector<std::string> wrongly_named(std::string_view text) {
  static const std::regex any(R"re(\b([Ee]quations?|[Ee]qn?s?\.?)\s*\(?(\d|[A-I])\.\d+)re");
  std::vector<std::string> found;
  const std::string whole(text);
  for (std::sregex_iterator match(whole.begin(), whole.end(), any), end; match != end; ++match)
    if (const std::string form = match->str(); !form.starts_with("Eq. ") && !form.starts_with("Eqs "))
      found.push_back(form);
  return found;
}

namespace {

// reads one file, line by line
class Reader {
 public:
  Reader(std::string file, Place place, SourceNames& found) : file_(std::move(file)), place_(place), found_(found) {}

  void read_source(const std::string& text) {
    static const std::regex test_line(R"re(^(?:TYPED_)?TEST(?:_F|_P)?\((\w+), *(\w+)\))re");
    std::istringstream lines(text);
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
      ++number;
      const std::size_t start = std::min(line.find_first_not_of(' '), line.size());
      if (line.compare(start, 2, "//") == 0) {
        if (comment_.empty()) comment_line_ = number;
        comment_ += " " + line.substr(std::min(line.find_first_not_of("/ ", start), line.size()));
        continue;
      }
      if (std::smatch match; line.find("TEST") != std::string::npos && std::regex_search(line, match, test_line)) {
        test_ = match[1].str() + "." + match[2].str();
        found_.tests.insert(test_);
      }
      take_comment();
      note(line, number);
      if (line == "}") test_.clear();
    }
    take_comment();
  }

  // paragraph by paragraph, since a name may be spread over two lines
  void read_page(const std::string& text) {
    std::istringstream lines(text);
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
      ++number;
      if (line.empty()) take_comment();
      if (line.empty()) continue;
      if (comment_.empty()) comment_line_ = number;
      comment_ += " " + line;
    }
    take_comment();
  }

 private:
  void take_comment() {
    if (!comment_.empty()) note(comment_, comment_line_);
    comment_.clear();
  }

  void note(const std::string& text, int line) {
    if (text.find("Eq") == std::string::npos && text.find("eq") == std::string::npos) return;
    for (const std::string& form : wrongly_named(text))
      found_.wrong.push_back(
          fmt::format("{}:{}: '{}' is not a valid name of an equation; write Eq. or Eqs", file_, line, form));
    const bool in_a_case = file_.starts_with("cases/");
    for (const std::string& number : equations_named(text)) {
      Place place = place_;
      if (!test_.empty())
        place = Place::test;
      else if (in_a_case && place_ != Place::page && text.find('"') != std::string::npos)
        place = Place::source;
      found_.namings.push_back({number, file_, line, place, test_});
    }
  }

  std::string file_, test_, comment_;
  Place place_;
  SourceNames& found_;
  int comment_line_ = 0;
};

Place place_of(const std::string& file) {
  if (file.find("/testing/") != std::string::npos || file.find("_test.") != std::string::npos) return Place::helper;
  if (file.starts_with("reference/")) return Place::reference;
  for (const char* room : {"core/", "app/", "text/", "cases/"})
    if (file.starts_with(room)) return Place::code;
  return Place::helper;
}

// CTest entries; a name that CMake composes of others is none of these
void read_programs(const std::string& text, std::set<std::string>& programs) {
  static const std::regex entry(
      R"re((voussoir_\w*test|voussoir_case|voussoir_same_bits|add_test)\((?:NAME )?([\w.]+)[\s)])re");
  for (std::sregex_iterator match(text.begin(), text.end(), entry), end; match != end; ++match) {
    const std::string command = (*match)[1];
    const char* prefix = command == "voussoir_case"        ? "case."
                         : command == "voussoir_same_bits" ? "unit.same_bits."
                                                           : "";
    programs.insert(prefix + (*match)[2].str());
  }
}

}  // namespace

SourceNames read_source_names(const fs::path& repository) {
  static constexpr std::array rooms{"app",  "benchmarks", "cases",   "core",      "docs",         "examples",
                                    "fuzz", "library",    "reports", "reference", "verification", "text"};
  std::vector<fs::path> files{repository / "README.md", repository / "CONTRIBUTING.md"};
  for (const char* room : rooms)
    if (fs::is_directory(repository / room))
      for (const auto& entry : fs::recursive_directory_iterator(repository / room))
        if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());

  SourceNames found;
  for (const fs::path& path : files) {
    const std::string file = path.lexically_relative(repository).generic_string(), kind = path.extension().string();
    const bool is_source = kind == ".cpp" || kind == ".hpp";
    const bool is_page = kind == ".md" || kind == ".gp" || (kind == ".toml" && file.starts_with("cases/"));
    if (path.filename() == "CMakeLists.txt" || kind == ".cmake")
      read_programs(verification::read_text(path), found.programs);
    if ((!is_source && !is_page) || !fs::exists(path)) continue;
    SourceNames of_file;
    Reader reader(file, is_page ? Place::page : place_of(file), of_file);
    is_page ? reader.read_page(verification::read_text(path)) : reader.read_source(verification::read_text(path));
    found.tests.merge(of_file.tests);
    // the tests of the matrix name equations that do not exist, and write names wrongly on purpose
    if (is_source && file.starts_with("reports/")) continue;
    found.namings.insert(found.namings.end(), of_file.namings.begin(), of_file.namings.end());
    found.wrong.insert(found.wrong.end(), of_file.wrong.begin(), of_file.wrong.end());
  }
  return found;
}

}  // namespace voussoir::reports
