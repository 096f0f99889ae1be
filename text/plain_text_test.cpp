// Plain text: which text is accepted, which is refused and at which place, and how the rest is shown.
#include "text/plain_text.hpp"

#include <gtest/gtest.h>

namespace voussoir::plain_text_test {
namespace {

void expect_fault(std::string_view text, std::size_t at, const std::string& part) {
  const auto fault = text_fault(text);
  ASSERT_TRUE(fault) << part;
  EXPECT_EQ(fault->at, at) << part;
  EXPECT_NE(fault->what.find(part), std::string::npos) << fault->what;
}

TEST(PlainText, TakesEveryScript) {
  for (const char* text : {"", "wedge 1", "Gewölbe – 45°", "岩盤", "скала", "πέτρα", "𝔻𝔼𝕄 🪨",
                           "\"a\", 'b' & <c>", "ñ\u0303", "\u00A0", "\U0010FFFD"})
    EXPECT_FALSE(text_fault(text)) << text;
  EXPECT_FALSE(text_fault("a\tb", true));
}

TEST(PlainText, RefusesBytesThatAreNoUtf8) {
  expect_fault(
      "S\xFC"
      "d",
      1, "0xFC, which is not UTF-8");
  expect_fault("\x80", 0, "0x80");
  expect_fault("a\xC0\x80", 1, "0xC0");         // overlong
  expect_fault("\xE0\x80\xAF", 0, "0xE0");      // overlong
  expect_fault("\xF0\x80\x80\xAF", 0, "0xF0");  // overlong
  expect_fault("\xED\xA0\x80", 0, "0xED");      // a surrogate
  expect_fault("\xF4\x90\x80\x80", 0, "0xF4");  // beyond U+10FFFF
  expect_fault("ab\xE2\x82", 2, "0xE2");        // cut short
  expect_fault("\xFF\xFE", 0, "0xFF");          // UTF-16
}

TEST(PlainText, RefusesCharactersThatControlATerminalOrTurnText) {
  expect_fault(std::string_view("a\0", 2), 1, "control character (U+0000)");
  expect_fault("\x1b[2J", 0, "control character (U+001B)");
  expect_fault("a\nb", 1, "control character (U+000A)");
  expect_fault("a\tb", 1, "control character (U+0009)");
  expect_fault("\x7f", 0, "control character (U+007F)");
  expect_fault("\u0085", 0, "control character (U+0085)");
  expect_fault("a\u009b31m", 1, "control character (U+009B)");
  expect_fault("\u2028", 0, "line separator (U+2028)");
  expect_fault("\u2029", 0, "line separator (U+2029)");
  for (const char* mark : {"\u061C", "\u200E", "\u200F", "\u202A", "\u202E", "\u2066", "\u2069"})
    expect_fault(mark, 0, "turns the direction");
  expect_fault("a\uFEFF", 1, "byte order mark");
  expect_fault("\uFFFE", 0, "no character");
  expect_fault("\uFFFF", 0, "no character");
  expect_fault("\uFDD0", 0, "no character");
}

TEST(PlainText, ShowsTheRestHarmlessly) {
  EXPECT_EQ(printable("a\x1b[31m\nb"), "a [31m b");
  EXPECT_EQ(printable("S\xFC"
                      "d\u009b"),
            "S�d�");
  EXPECT_EQ(printable("Süd"), "Süd");
  EXPECT_EQ(one_line("abcdef", 6), "abcdef");
  EXPECT_EQ(one_line("abcdefg", 6), "abcdef…");
  EXPECT_EQ(one_line("abcdeüg", 6), "abcdeü…") << "never within a character";
  for (const std::string_view text : {"\x1b\xFF\u202E", "\xF4\x90\x80\x80", "\xE2\x82"})
    EXPECT_FALSE(text_fault(printable(text)));
}

}  // namespace
}  // namespace voussoir::plain_text_test
