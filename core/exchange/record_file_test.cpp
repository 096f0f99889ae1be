// Files of records as they are met, and damaged ones.
#include "core/exchange/record_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace voussoir::record_file_test {
namespace {

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}

const std::string head =
    "PEER NGA STRONG MOTION DATABASE RECORD\nNowhere-01, 1/1/2000, A Place, 270\nACCELERATION TIME SERIES IN UNITS OF "
    "G\n";
const std::string body =
    "  -.1000000E-02  -.2000000E-02   .3000000E-02   .4000000E-02  -.5000000E-02\n   .6000000E-02  -.7000000E-02\n";
const std::string plain = head + "NPTS=  7, DT= .01000 SEC\n" + body;
const std::vector<double> seven{-0.001, -0.002, 0.003, 0.004, -0.005, 0.006, -0.007};

void expect_seven(const std::string& text) {
  const RecordFile record = read_record_file(text, {});
  EXPECT_EQ(record.values, seven);
  EXPECT_EQ(record.interval, 0.01);
  EXPECT_EQ(record.unit, "g");
  EXPECT_EQ(record.quantity, MotionQuantity::acceleration);
  EXPECT_EQ(record.component, "270");
  EXPECT_TRUE(record.remarks.empty());
}

void expect_refused(const std::string& text, const std::string& reason, int line, const RecordLayout& layout = {}) {
  SCOPED_TRACE(reason);
  try {
    read_record_file(text, layout);
    ADD_FAILURE() << "accepted";
  } catch (const FileFault& fault) {
    EXPECT_NE(std::string(fault.what()).find(reason), std::string::npos) << fault.what();
    EXPECT_EQ(std::string(fault.what()).find('\n'), std::string::npos);
    EXPECT_EQ(fault.line, line);
  }
}

TEST(RecordFile, ReadsAT2InItsThreeHeaders) {
  expect_seven(plain);
  expect_seven(head + "NPTS=      7, DT=   .0100 SEC,   0 POLE @    30.00000 HZ,   0 POLE @      .00000\n" + body);
  expect_seven(replaced(head, "SERIES", "HISTORY") + "7 0.01000 NPTS, DT\n" + body);
}

TEST(RecordFile, ReadsAT2AsProgramsWriteIt) {
  expect_seven(replaced(plain, "\n", "\r\n"));
  expect_seven(plain + "\n   \n\x1a");
  expect_seven(replaced(plain, "E-02", "D-02"));
  expect_seven(head +
               "NPTS=  7, DT= .01000 SEC\n-.1000000E-02-.2000000E-02.3000000E-02 "
               ".4000000E-02-.5000000E-02\n.6000000E-02-.7000000E-02");
  const RecordFile velocities =
      read_record_file(replaced(replaced(plain, "ACCELERATION", "VELOCITY"), "OF G", "OF CM/SEC"), {});
  EXPECT_EQ(velocities.unit, "cm/s");
  EXPECT_EQ(velocities.quantity, MotionQuantity::velocity);
  const RecordFile word = read_record_file(replaced(plain, "A Place, 270", "A Place, UP"), {});
  EXPECT_EQ(word.component, "UP");
}

TEST(RecordFile, TakesNPTSOfMoreValuesAndSaysSo) {
  const RecordFile record = read_record_file(replaced(plain, "NPTS=  7", "NPTS=  6"), {});
  EXPECT_EQ(record.values, std::vector<double>(seven.begin(), seven.end() - 1));
  ASSERT_EQ(record.remarks.size(), 1u);
  EXPECT_EQ(record.remarks.front().line, 4);
  EXPECT_NE(record.remarks.front().text.find("1 values follow more"), std::string::npos);
}

TEST(RecordFile, RefusesDamagedAT2) {
  expect_refused(replaced(plain, "NPTS=  7", "NPTS=  8"), "ends after 7 of NPTS = 8", 6);
  expect_refused(replaced(plain, ".3000000E-02", "NaN"), "'NaN' is no finite number", 5);
  expect_refused(replaced(plain, ".3000000E-02", "*******"), "is no finite number", 5);
  expect_refused(replaced(plain, ".3000000E-02", "1E999"), "is no finite number", 5);
  expect_refused(head + "NPTS=  7\n" + body, "states no number of values (NPTS) and interval (DT)", 4);
  expect_refused(replaced(plain, "DT= .01", "DT= .00"), "states no number of values", 4);
  expect_refused(replaced(plain, "NPTS=  7", "NPTS=  1"), "states no number of values", 4);
  expect_refused(replaced(plain, "NPTS=  7", "NPTS=  1000000"), "more than 200000 values", 4);
  expect_refused(head + body, "second line that begins with a word", 2);
  expect_refused(body, "has 5 columns, and interval_s is stated", 1, {.interval = 0.01, .column = {}});
}

void expect_same(const std::string& text, const RecordLayout& layout = {}) {
  SCOPED_TRACE(text);
  const RecordFile record = read_record_file(text, layout);
  EXPECT_EQ(record.values, (std::vector<double>{0, 1.5, -2}));
  EXPECT_EQ(record.interval, 0.02);
  EXPECT_TRUE(record.unit.empty());
  EXPECT_FALSE(record.quantity);
}

TEST(RecordFile, ReadsColumns) {
  expect_same("time,acceleration\n0,0\n0.02,1.5\n0.04,-2\n");
  expect_same("# a comment\n\"t (s)\";\"a\"\r\n0,00;0\r\n0,02;1,5\r\n0,04;-2\r\n");
  expect_same("0.00\t0\n0.02\t1.5\n0.04\t-2");
  expect_same("  0.00   0\n\n  0.02   +1.5\n # inside\n  0.04  -2e0\n");
  expect_same("5.00, 9, 0\n5.02, 9, 1.5\n5.04, 9, -2\n", {.interval = {}, .column = 3});
  expect_same("0\n1.5\n-2\n", {.interval = 0.02, .column = {}});
  expect_same("a\n0\n1,5\n-2\n", {.interval = 0.02, .column = {}});
  expect_same("7 0\n7 1.5\n7 -2\n", {.interval = 0.02, .column = 2});
}

TEST(RecordFile, AcceptsTimesThatArePrintedWithFewDigits) {
  std::string text;
  for (int i = 0; i < 300; ++i)
    text += std::to_string(i / 256.0) + " " + std::to_string(i) + "\n";  // six decimals of an interval of 0.00390625
  EXPECT_NEAR(read_record_file(text, {}).interval, 1 / 256.0, 1e-8);
}

TEST(RecordFile, RefusesColumnsThatAreNoRecord) {
  expect_refused("0 0\n0.02 1\n0.05 2\n0.06 3\n", "is uneven", 3);
  expect_refused("0 0\n0.02 1\n0.02 2\n", "times must rise", 3);
  expect_refused("0 0\n0.02 NaN\n0.04 2\n", "'NaN' is no finite number", 2);
  expect_refused("NaN\n1\n", "'NaN' is no finite number", 1, {.interval = 0.01, .column = {}});
  expect_refused("0 0\n0.02 inf\n", "'inf' is no finite number", 2);
  expect_refused("0 0\n0.02\n", "has 1 columns, the lines before it 2", 2);
  expect_refused("1\n2\n", "state interval_s", 1);
  expect_refused("0 1 2\n", "state column", 1);
  expect_refused("0 1\n", "column = 3", 1, {.interval = {}, .column = 3});
  expect_refused("0 1\n", "column = 1 has the times", 1, {.interval = {}, .column = 1});
  expect_refused("0 1\n1 2\n", "interval_s is stated for a file without times", 1, {.interval = 0.1, .column = {}});
  expect_refused("", "fewer than two values", 0);
  expect_refused("t a\n0 1\n", "fewer than two values", 2);
  expect_refused("t a\ns g\n0 1\n", "second line that begins with a word", 2);
  expect_refused("0 0\n0.02 1 #!\n", "columns", 2);
  expect_refused(std::string("0 0\n0.02 \x01\n"), "control character", 2);
}

TEST(RecordFile, NamesTheFormatsThatItDoesNotRead) {
  expect_refused("Origin Time       2011/03/11 14:46:00\nLat.              38.103\n", "format K-NET", 1);
  expect_refused("EVENT_NAME: L_AQUILA\nEVENT_ID: IT-2009\n", "format ESM or ITACA", 1);
  expect_refused("Corrected accelerogram (Format v01.20 with 13 text lines) Src: COSMOS\n", "format COSMOS", 1);
}

// the limit is checked as the values are read
TEST(RecordFile, RefusesAMillionRows) {
  std::string text;
  for (int i = 0; i < 1'000'000; ++i)
    text += "0.1\n";
  expect_refused(text, "more than 200000 values", 200'001, {.interval = 0.01, .column = {}});
}

TEST(RecordFile, HasUnitsOfEveryQuantity) {
  EXPECT_EQ(find_record_unit("g")->size, 9.80665);
  EXPECT_EQ(find_record_unit("cm/s")->quantity, MotionQuantity::velocity);
  EXPECT_EQ(find_record_unit("mm")->size, 0.001);
  EXPECT_EQ(find_record_unit("ft"), nullptr);
}

}  // namespace
}  // namespace voussoir::record_file_test
