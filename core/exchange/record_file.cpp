#include "core/exchange/record_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "core/exchange/record_numbers.hpp"
#include "text/text_scan.hpp"

namespace voussoir {
namespace {

std::string upper_case(std::string_view text) {
  std::string upper(text);
  std::transform(upper.begin(), upper.end(), upper.begin(), [](unsigned char c) { return std::toupper(c); });
  return upper;
}

struct TextLine {
  int number = 0;
  std::string_view text;
};

constexpr std::size_t head_lines = 8;  // AT2 states NPTS in its fourth line, as a rule

std::vector<TextLine> first_lines(std::string_view text) {
  std::vector<TextLine> lines;
  LineReader reader(text);
  while (lines.size() < head_lines && reader.next())
    lines.push_back({reader.number(), reader.line()});
  return lines;
}

// formats that users have and that are not read
void refuse_other_formats(const std::vector<TextLine>& head) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 8> marks{{{"ORIGIN TIME", "K-NET or KiK-net"},
                                                                                {"EVENT_NAME:", "ESM or ITACA"},
                                                                                {"EVENT_ID:", "ESM or ITACA"},
                                                                                {"COSMOS", "COSMOS"},
                                                                                {"CORRECTED ACCELEROGRAM", "COSMOS"},
                                                                                {"RAW ACCELERATION", "COSMOS"},
                                                                                {"CORRECTED ACCELERATION", "COSMOS"},
                                                                                {"CSMIP", "CSMIP"}}};
  for (const TextLine& line : head)
    for (const auto& [mark, format] : marks)
      if (upper_case(line.text).find(mark) != std::string::npos)
        throw FileFault(line.number, 0,
                        fmt::format("is a file of the format {}, which is not read; save its values as one column, "
                                    "without header and with the constant offset taken off, and state interval_s, "
                                    "quantity and unit",
                                    format));
}

// ---- AT2 ------------------------------------------------------------------------------------------------------------

// the number behind a word and an equals sign, as in "NPTS=   1999"
std::string_view number_behind(std::string_view line, std::string_view word) {
  const std::size_t found = line.find(word);
  if (found == std::string_view::npos) return {};
  const std::size_t at = line.find_first_not_of(" \t=:", found + word.size());
  if (at == std::string_view::npos) return {};
  return line.substr(at, record_number_length(line.substr(at)));
}

struct CountAndInterval {
  std::string_view count, interval;
};

// "NPTS=  1999, DT= .0100 SEC", or of older files "1999 0.0100 NPTS, DT"
CountAndInterval count_and_interval(std::string_view line) {
  CountAndInterval found{number_behind(line, "NPTS"), number_behind(line, "DT")};
  if (!found.count.empty() && !found.interval.empty()) return found;
  std::array<std::string_view, 2> numbers;
  std::size_t at = 0;
  for (std::string_view& number : numbers) {
    at = std::min(line.find_first_not_of(" \t,", at), line.size());
    number = line.substr(at, record_number_length(line.substr(at)));
    at += number.size();
  }
  return {numbers[0], numbers[1]};
}

// the unit behind "UNITS OF", and the quantity that the same line names
void read_unit(const TextLine& line, RecordFile& record) {
  const std::string upper = upper_case(line.text);
  std::size_t at = upper.find("UNITS OF");
  std::size_t length = 8;
  if (at == std::string::npos) at = upper.find("UNIT OF"), length = 7;
  if (at == std::string::npos) return;
  std::string word;
  for (const char c : upper.substr(at + length)) {
    if (!std::isspace(static_cast<unsigned char>(c)) && c != ',' && c != ';')
      word += c;
    else if (!word.empty())
      break;
  }
  constexpr std::array<std::pair<std::string_view, std::string_view>, 13> words{{{"G", "g"},
                                                                                 {"CM/S/S", "cm/s2"},
                                                                                 {"CM/S2", "cm/s2"},
                                                                                 {"CM/S**2", "cm/s2"},
                                                                                 {"CM/SEC/SEC", "cm/s2"},
                                                                                 {"CM/SEC2", "cm/s2"},
                                                                                 {"GAL", "gal"},
                                                                                 {"M/S2", "m/s2"},
                                                                                 {"M/S/S", "m/s2"},
                                                                                 {"CM/S", "cm/s"},
                                                                                 {"CM/SEC", "cm/s"},
                                                                                 {"CM", "cm"},
                                                                                 {"M", "m"}}};
  for (const auto& [theirs, ours] : words)
    if (word == theirs) record.unit = ours;
  for (const MotionQuantity quantity :
       {MotionQuantity::acceleration, MotionQuantity::velocity, MotionQuantity::displacement})
    if (upper.find(upper_case(word_of(quantity))) != std::string::npos) record.quantity = quantity;
}

[[noreturn]] void refuse_many(int line) {
  throw FileFault(line, 0,
                  fmt::format("has more than {} values, the most that a record may have; cut it, or take every second "
                              "value of a record without frequencies above a quarter of its rate",
                              most_record_values));
}

struct AtHead {
  std::size_t count = 0;
  std::size_t lines = 0;
};

AtHead read_at2_head(const std::vector<TextLine>& head, std::size_t at, RecordFile& record) {
  const std::string upper = upper_case(head[at].text);
  const auto [count, interval] = count_and_interval(upper);
  const int line = head[at].number;
  const double stated = count.empty() ? 0 : record_number(count, line, 0);
  record.interval = interval.empty() ? 0 : record_number(interval, line, 0);
  if (!(stated >= 2) || stated != std::floor(stated) || !(record.interval > 0))
    throw FileFault(line, 0,
                    fmt::format("{} states no number of values (NPTS) and interval (DT); write for example NPTS= 4000, "
                                "DT= .0050 SEC",
                                shown(head[at].text)));
  if (stated > static_cast<double>(most_record_values)) refuse_many(line);
  for (std::size_t k = 0; k < at; ++k)
    read_unit(head[k], record);
  if (at >= 2)
    if (const std::vector<Word> words = words_of(head[1].text, head[1].number); !words.empty())
      record.component = words.back().text;
  return {static_cast<std::size_t>(stated), at + 1};
}

RecordFile read_at2(std::string_view text, const std::vector<TextLine>& head, std::size_t at) {
  RecordFile record;
  const AtHead stated = read_at2_head(head, at, record);
  LineReader reader(text);
  for (std::size_t k = 0; k < stated.lines; ++k)
    reader.next();
  std::size_t beyond = 0;
  while (reader.next()) {
    add_record_numbers(reader.line(), reader.number(), record.values);
    if (record.values.size() > stated.count) {
      beyond += record.values.size() - stated.count;
      record.values.resize(stated.count);
    }
  }
  if (record.values.size() < stated.count)
    throw FileFault(reader.number(), 0,
                    fmt::format("the file ends after {} of NPTS = {} values; get it again, or correct NPTS",
                                record.values.size(), stated.count));
  if (beyond > 0)
    record.remarks.push_back({head[at].number, fmt::format("NPTS = {}, and {} values follow more than that: they are "
                                                           "left out",
                                                           stated.count, beyond)});
  return record;
}

// ---- tables ---------------------------------------------------------------------------------------------------------

struct RecordCell {
  std::string text;
  int column = 0;
};

// a line's cells: between semicolons, or else between blanks, tabs and commas
std::vector<RecordCell> cells_of(std::string_view line, bool decimal_comma) {
  const std::string_view between = line.find(';') != std::string_view::npos ? ";" : decimal_comma ? " \t" : " \t,";
  std::vector<RecordCell> cells;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t begin = line.find_first_not_of(between, at);
    if (begin == std::string_view::npos) break;
    at = std::min(line.find_first_of(between, begin), line.size());
    std::string_view word = line.substr(begin, at - begin);
    while (!word.empty() && (word.front() == ' ' || word.front() == '\t' || word.front() == '"'))
      word.remove_prefix(1);
    while (!word.empty() && (word.back() == ' ' || word.back() == '\t' || word.back() == '"'))
      word.remove_suffix(1);
    RecordCell cell{std::string(word), static_cast<int>(begin) + 1};
    if (between == ";" || decimal_comma) std::replace(cell.text.begin(), cell.text.end(), ',', '.');
    if (!cell.text.empty()) cells.push_back(std::move(cell));
  }
  return cells;
}

bool is_number(const RecordCell& cell) {
  return record_number_length(cell.text) == cell.text.size();
}

// of a column, not the value that programs print for a number that they do not have
bool is_name(const RecordCell& cell) {
  const std::string upper = upper_case(cell.text);
  return !is_number(cell) && upper.find("NAN") == std::string::npos && upper.find("INF") == std::string::npos;
}

double value_of(const RecordCell& cell, int line) {
  if (!is_number(cell)) throw FileFault(line, cell.column, no_record_number(cell.text));
  return record_number(cell.text, line, cell.column);
}

// half of the last digit of a printed number
double last_digit(std::string_view number) {
  const std::size_t exponent = number.find_first_of("eEdD");
  const std::string_view mantissa = number.substr(0, exponent);
  const std::size_t point = mantissa.find('.');
  double power = point == std::string_view::npos ? 0 : -static_cast<double>(mantissa.size() - point - 1);
  if (exponent != std::string_view::npos) power += record_number(number.substr(exponent + 1), 0, 0);
  return 0.5 * std::pow(10.0, std::clamp(power, -300.0, 300.0));
}

struct TimeColumn {
  std::vector<double> times;  // s
  std::vector<double> slack;  // s, half of their last digits
  std::vector<int> lines;
};

// the interval of equally spaced times
double interval_of(const TimeColumn& column) {
  constexpr double relative = 1e-6, most_slack = 0.05;  // of the interval
  const std::vector<double>& times = column.times;
  for (std::size_t i = 1; i < times.size(); ++i)
    if (!(times[i] > times[i - 1]))
      throw FileFault(column.lines[i], 0,
                      fmt::format("the time {:g} s does not follow {:g} s; times must rise: print them with more "
                                  "digits, or leave the column out and state interval_s",
                                  times[i], times[i - 1]));
  // twelve digits: differences of decimal times are rounded
  const double mean = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  const std::string printed = fmt::format("{:.12g}", mean);
  const double interval = record_number(printed, column.lines.front(), 0);
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double expected = times.front() + interval * static_cast<double>(i);
    const double slack = std::max(relative * interval, std::min(2 * column.slack[i], most_slack * interval));
    if (std::abs(times[i] - expected) > slack)
      throw FileFault(
          column.lines[i], 0,
          fmt::format("the time {:g} s is uneven: {} values from {:g} to {:g} s have an interval of {:g} s, "
                      "and this one would be at {:g} s; interpolate the record at equal intervals",
                      times[i], times.size(), times.front(), times.back(), interval, expected));
  }
  return interval;
}

// Which cells hold times (or none, 0) and values, from 1.
struct RecordColumns {
  std::size_t time = 0, value = 1;
};

RecordColumns columns_of(const std::vector<RecordCell>& cells, int line, const RecordLayout& layout) {
  const std::size_t stated = static_cast<std::size_t>(layout.column.value_or(0));
  if (stated > cells.size())
    throw FileFault(line, 0,
                    fmt::format("has {} columns, but column = {}; name one that it has", cells.size(), stated));
  if (layout.interval) {
    if (cells.size() > 1 && stated == 0)
      throw FileFault(line, 0,
                      fmt::format("has {} columns, and interval_s is stated for a file without times; leave interval_s "
                                  "out if the first column has times, or state column",
                                  cells.size()));
    return {0, std::max<std::size_t>(stated, 1)};
  }
  if (cells.size() == 1)
    throw FileFault(line, 0, "has one column and no times; state interval_s, the time from one value to the next");
  if (cells.size() > 2 && stated == 0)
    throw FileFault(
        line, 0,
        fmt::format("has {} columns; state column, that of the values (the first has the times)", cells.size()));
  if (stated == 1) throw FileFault(line, 0, "column = 1 has the times; state that of the values, from 2 on");
  return {1, stated == 0 ? 2 : stated};
}

bool has_decimal_comma(const std::vector<TextLine>& head, const RecordLayout& layout) {
  if (!layout.interval) return false;
  return std::none_of(head.begin(), head.end(),
                      [](const TextLine& line) { return line.text.find('.') != std::string_view::npos; });
}

RecordFile read_table(std::string_view text, const std::vector<TextLine>& head, const RecordLayout& layout) {
  RecordFile record;
  TimeColumn times;
  RecordColumns columns;
  std::size_t width = 0;
  bool named = false;
  const bool decimal_comma = has_decimal_comma(head, layout);
  LineReader reader(text);
  while (reader.next()) {
    const std::vector<RecordCell> cells = cells_of(reader.line(), decimal_comma);
    const int line = reader.number();
    if (cells.empty() || cells.front().text.starts_with('#')) continue;
    if (width == 0 && is_name(cells.front())) {
      if (named)
        throw FileFault(
            line, 0,
            fmt::format("{} is a second line that begins with a word; a table has one line of names at most, and "
                        "AT2 a line with NPTS and DT among its first eight",
                        shown(reader.line())));
      named = true;  // the line of names
      continue;
    }
    if (width == 0) {
      columns = columns_of(cells, line, layout);
      width = cells.size();
    }
    if (cells.size() != width)
      throw FileFault(
          line, 0, fmt::format("has {} columns, the lines before it {}; give every line as many", cells.size(), width));
    record.values.push_back(value_of(cells[columns.value - 1], line));
    if (record.values.size() > most_record_values) refuse_many(line);
    if (columns.time == 0) continue;
    times.times.push_back(value_of(cells[columns.time - 1], line));
    times.slack.push_back(last_digit(cells[columns.time - 1].text));
    times.lines.push_back(line);
  }
  if (record.values.size() < 2)
    throw FileFault(reader.number(), 0, "has fewer than two values; is it the file of a record?");
  record.interval = columns.time == 0 ? *layout.interval : interval_of(times);
  return record;
}

}  // namespace

const std::vector<RecordUnit>& record_units() {
  constexpr double standard_fall = 9.80665;  // m/s²: g, whatever the gravity of a scene
  using enum MotionQuantity;
  static const std::vector<RecordUnit> units{
      {"g", acceleration, standard_fall}, {"m/s2", acceleration, 1}, {"cm/s2", acceleration, 0.01},
      {"gal", acceleration, 0.01},        {"m/s", velocity, 1},      {"cm/s", velocity, 0.01},
      {"mm/s", velocity, 0.001},          {"m", displacement, 1},    {"cm", displacement, 0.01},
      {"mm", displacement, 0.001}};
  return units;
}

const RecordUnit* find_record_unit(std::string_view word) {
  const std::vector<RecordUnit>& units = record_units();
  const auto found =
      std::find_if(units.begin(), units.end(), [&](const RecordUnit& unit) { return unit.word == word; });
  return found == units.end() ? nullptr : &*found;
}

std::string_view word_of(MotionQuantity quantity) {
  constexpr std::array<std::string_view, 3> words{"acceleration", "velocity", "displacement"};
  return words[static_cast<std::size_t>(quantity)];
}

RecordFile read_record_file(std::string_view text, const RecordLayout& layout) {
  while (text.ends_with('\x1a'))  // the end mark of old systems
    text.remove_suffix(1);
  const std::vector<TextLine> head = first_lines(text);
  for (std::size_t at = 0; at < head.size(); ++at)
    if (upper_case(head[at].text).find("NPTS") != std::string::npos) return read_at2(text, head, at);
  refuse_other_formats(head);
  return read_table(text, head, layout);
}

}  // namespace voussoir
