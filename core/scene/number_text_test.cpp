// Notation of numbers and texts: independent of the locale, exact to the last digit, and never read in part.
#include <gtest/gtest.h>

#include <algorithm>
#include <clocale>
#include <cmath>
#include <locale>

#include "core/scene/scene.hpp"

namespace voussoir::number_text_test {
namespace {

const std::string head =
    "dimension = 2\ndensity = 2000\n[[blocks]]\nname = \"a\"\nbox = { min = [0, 0], max = [1, 1] }\n";
const std::string tail = "[[stage]]\nname = \"s\"\nkind = \"settle\"\n";

// a scene that states a number, or the error message
std::string with_number(const std::string& text) {
  return head + "velocity = [0, " + text + "]\n" + tail;
}

std::optional<double> number(const std::string& text) {
  try {
    return parse_scene(with_number(text), "scene.toml").blocks.at(0).motion.velocity->at(1);
  } catch (const SceneError& error) {
    EXPECT_EQ(std::string(error.what()).find_first_of("\r\n"), std::string::npos);
    return {};
  }
}

// decimal commas and grouped thousands in every stream, and in C if such a locale is installed
class CommaLocale {
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };

 public:
  CommaLocale() : before_(std::locale::global(std::locale(std::locale::classic(), new Comma))) {
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"})
      if (std::setlocale(LC_NUMERIC, name)) break;
  }
  ~CommaLocale() {
    std::setlocale(LC_NUMERIC, "C");
    std::locale::global(before_);
  }

 private:
  std::locale before_;
};

const std::pair<const char*, double> good_numbers[] = {
    {"0", 0},
    {"-0", 0},
    {"-0.0", 0},
    {"+0.0", 0},
    {"1", 1},
    {"+1", 1},
    {"-1", -1},
    {"1_000", 1000},
    {"1_000.5", 1000.5},
    {"0.1", 0.1},
    {"1e3", 1000},
    {"1E3", 1000},
    {"1e+3", 1000},
    {"1.5e-3", 1.5e-3},
    {"-2.5E+2", -250},
    {"123456.789", 123456.789},
    {"0.30000000000000004", 0.30000000000000004},
    {"0.1000000000000000055511151231257827", 0.1},
    {"1e-99", 1e-99},
};

const char* const bad_numbers[] = {"",         "1.",       ".5",
                                   "1.e3",     "01",       "00",
                                   "1__0",     "_1",       "1_",
                                   "1e",       "1e+",      "e3",
                                   "1e3.5",    "--1",      "+-1",
                                   "1 0",      "1,5,",     "1.2.3",
                                   "1.5m",     "1f",       "1d3",
                                   "1e400",    "-1e400",   "1e308",
                                   "1e-310",   "4.9e-324", "1e-400",
                                   "0x10",     "0X10",     "0o17",
                                   "0b11",     "0x1p3",    "nan",
                                   "+nan",     "inf",      "-inf",
                                   "Infinity", "NaN",      "1e1000000000",
                                   "\"1\"",    "'1'",      "true",
                                   "[1]",      "{}",       "1979-05-27",
                                   "07:32:00", "１",       "1°",
                                   "½",        "1 # m\n2", "9223372036854775808",
                                   "1e13",     "−1",       "1'000",
                                   "(1)"};

TEST(Numbers, AreReadOrRefusedWhateverTheLocale) {
  for (const bool comma : {false, true}) {
    std::optional<CommaLocale> locale;
    if (comma) locale.emplace();
    for (const auto& [text, value] : good_numbers) {
      const std::optional<double> read = number(text);
      ASSERT_TRUE(read) << text;
      EXPECT_EQ(*read, value) << text;
      EXPECT_EQ(std::signbit(*read), value < 0) << text << ": a zero has no sign";
    }
    for (const char* text : bad_numbers)
      EXPECT_FALSE(number(text)) << text;
  }
}

// a number with seventeen digits reads back to the same bits, as a number and in the canonical text
TEST(Numbers, KeepTheirBits) {
  const CommaLocale locale;
  double x = 0.7;
  for (int i = 0; i < 200; ++i) {
    x = 3.99 * x * (1 - x);
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", x * std::pow(10, i % 20 - 10));
    std::string dotted = text;
    if (const auto at = dotted.find(','); at != std::string::npos) dotted[at] = '.';
    const std::optional<double> read = number(dotted);
    ASSERT_TRUE(read) << dotted;
    EXPECT_EQ(*read, x * std::pow(10, i % 20 - 10));
  }
  EXPECT_NE(canonical_text(parse_scene(with_number("0.5"), "s")).find("0.5"), std::string::npos);
}

TEST(Texts, MayHaveABomAndWindowsLineEnds) {
  const std::string good = with_number("1");
  const std::string canonical = canonical_text(parse_scene(good, "scene.toml"));
  EXPECT_EQ(canonical_text(parse_scene("\xEF\xBB\xBF" + good, "scene.toml")), canonical);
  std::string windows;
  for (const char c : good)
    windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(canonical_text(parse_scene(windows, "scene.toml")), canonical);
}

TEST(Texts, OfOtherEncodingsAreRefusedInOneLine) {
  std::string wide;
  for (const char c : with_number("1"))
    wide += std::string(1, c) + '\0';
  const std::string good = with_number("1");
  const std::string bad[] = {"\xFF\xFE" + wide,
                             wide,
                             good + std::string(1, '\0'),
                             "a = \"" + std::string(1, '\0') + "\"\n" + good,
                             "title = \"\x01\"\n" + good,
                             "title = \"\xC3\x28\"\n" + good,
                             "title = \"\xE9\"\n" + good,
                             "title = \"\xED\xA0\x80\"\n" + good,
                             "title = \"\\u0000\"\n" + good,
                             "title = \"\\uD800\"\n" + good,
                             "# \x7f\n" + good + "\r",
                             "\x1b[2J" + good};
  for (const std::string& text : bad) {
    try {
      parse_scene(text, "scene.toml");
      ADD_FAILURE() << "accepted: " << testing::PrintToString(text.substr(0, 40));
    } catch (const SceneError& error) {
      const std::string message = error.what();
      EXPECT_TRUE(message.starts_with("scene.toml")) << message;
      EXPECT_TRUE(std::none_of(message.begin(), message.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }))
          << testing::PrintToString(message);
    }
  }
}

}  // namespace
}  // namespace voussoir::number_text_test
