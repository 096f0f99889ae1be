// Tables: every written text comes back unchanged; malformed ones are reported with the place.
#include "text/csv_table.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace voussoir::csv_table_test {
namespace {

void expect_fault(const std::string& text, std::size_t most_rows, int line, int column, const std::string& part) {
  SCOPED_TRACE(part);
  try {
    parse_csv(text, most_rows);
    ADD_FAILURE() << "read without an error";
  } catch (const FileFault& fault) {
    EXPECT_EQ(fault.line, line) << fault.what();
    EXPECT_EQ(fault.column, column) << fault.what();
    EXPECT_NE(std::string(fault.what()).find(part), std::string::npos) << fault.what();
  }
}

TEST(CsvTable, ReadsQuotesBlanksAndEveryLineEnd) {
  const CsvTable table = parse_csv(
      "\xEF\xBB\xBF"
      "name, x_m ,note\r\n\r\n\"a, \"\"b\"\"\" , 1.5,\n c ,-2e3, d d \n");
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.text(table.rows[0], "name"), "a, \"b\"");
  EXPECT_EQ(table.number(table.rows[0], "x_m"), 1.5);
  EXPECT_EQ(table.text(table.rows[0], "note"), "");
  EXPECT_EQ(table.text(table.rows[1], "note"), "d d");
  EXPECT_EQ(table.rows[0].line, 3);
  EXPECT_EQ(table.rows[1].cells[1].column, 5);
}

TEST(CsvTable, ReportsThePlaceOfAnError) {
  const auto fault = [](const std::string& text, int line, int column, const std::string& part) {
    expect_fault(text, 100, line, column, part);
  };
  fault("", 1, 0, "is empty");
  fault("\n  \n", 1, 0, "is empty");
  fault("a,,c\n", 1, 3, "without a name");
  fault("a,b,a\n", 1, 5, "occurs twice");
  fault("a,b\n1\n", 2, 0, "has 1 cells, but the header has 2");
  fault("a,b\n1,2,3\n", 2, 0, "has 3 cells");
  fault("a,b\n1,\"2\n", 2, 3, "not closed");
  fault("a,b\n\"1\"2,3\n", 2, 4, "behind a closed quote");
  fault(std::string("a,b\n1,\0", 7), 2, 3, "control character");
  fault("a,b\n1,\xE4\n", 2, 3, "the byte 0xE4, which is not UTF-8; save the file as plain text in UTF-8");
  fault("a,b\n1,x\xE2\x80\xAEy\n", 2, 4, "turns the direction of text (U+202E)");
  fault(std::string(100'000, ','), 1, 201, "more than 200 columns");
  expect_fault("a\n1\n2\n\n3\n", 2, 5, 0, "more than 2 rows");
}

TEST(CsvTable, EveryTextComesBack) {
  const std::vector<std::string> texts{
      "plain", "a,b",    "say \"so\"", "",         " blanks ",  "Süd; Nord", "'quoted'",  "=1+1",   "'=1+1",
      "''=x",  "+x",     "-45 deg",    "@SUM(A1)", "-",         "'-5",       "-5",        "+3.5e2", "'",
      "'a",    "\"=1\"", "1e999",      "#a",       "a # \"b\"", "\"",        "# \"a\", b"};
  std::string header;
  for (std::size_t k = 0; k < texts.size(); ++k)
    header += (k > 0 ? ",c" : "c") + std::to_string(k);
  const CsvTable table = parse_csv(header + "\r\n" + csv_line(texts) + "\r\n");
  ASSERT_EQ(table.rows.size(), 1u);
  ASSERT_EQ(table.rows[0].cells.size(), texts.size());
  for (std::size_t k = 0; k < texts.size(); ++k)
    EXPECT_EQ(table.rows[0].cells[k].text, texts[k]);
}

TEST(CsvTable, NoCellIsAFormula) {
  for (const char* formula : {"=1+1", "+x", "-x", "@x", "-1-1", "+1+1", "=cmd|' /C calc'!A0"})
    EXPECT_EQ(csv_cell(std::string(formula)), "'" + std::string(formula));
  for (const char* number : {"-1", "+1", "-1e-300", "-.5", "0"})
    EXPECT_EQ(csv_cell(std::string(number)), number);
  EXPECT_EQ(csv_cell(std::string("=A1,B1")), "\"'=A1,B1\"");
  EXPECT_EQ(csv_cell(-0.5), "-0.5");
  EXPECT_EQ(csv_cell(std::numeric_limits<double>::quiet_NaN()), "");
  EXPECT_EQ(csv_cell(std::optional<double>()), "");
}

// gnuplot and numpy: a # outside of quotes begins a comment, doubled quotes within quotes are not known to gnuplot
TEST(CsvTable, OtherReadersFindEveryCell) {
  EXPECT_EQ(csv_cell(std::string("#rock")), "\"#rock\"");
  EXPECT_EQ(csv_cell(std::string("rock #2")), "\"rock #2\"");
  EXPECT_EQ(csv_cell(std::string("'rock")), "'rock");
  EXPECT_EQ(csv_cell(std::string("say \"so\"")), "say \"so\"");
  EXPECT_EQ(csv_cell(std::string("\"so\"")), "\"\"\"so\"\"\"");
}

TEST(CsvTable, ACellIsOneLineOfPlainText) {
  EXPECT_EQ(csv_cell(std::string("two\nlines")), "two lines");
  EXPECT_EQ(csv_cell(std::string("\x1b[31mred")), "\" [31mred\"");
}

TEST(CsvReader, ReadsRowByRow) {
  CsvReader reader("\n\"left,upper\",x\n1,2\n\n3,4\n", 2);
  EXPECT_EQ(reader.header_line(), 2);
  EXPECT_EQ(reader.find("left,upper"), 0u);
  EXPECT_FALSE(reader.find("upper\""));
  CsvRow row;
  ASSERT_TRUE(reader.next(row));
  EXPECT_EQ(row.cells[1].text, "2");
  ASSERT_TRUE(reader.next(row));
  EXPECT_EQ(row.line, 5);
  EXPECT_FALSE(reader.next(row));
  EXPECT_THROW(CsvReader("a,b,c\n", 2), FileFault);
}

}  // namespace
}  // namespace voussoir::csv_table_test
