#include "cases/tunnel/draws.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "text/csv_table.hpp"

namespace voussoir::cases {
namespace {

const std::array<std::string, 4> places{"roof", "left_wall", "right_wall", "floor"};

// the first word of the mechanism of a roof for which the table has this letter
std::string kind_word(char first) {
  return first == 'W' ? "wedge" : first == 'm' ? "fall" : "slide";
}

bool holds(const std::string& letters, char letter) {
  return letters.find(letter) != std::string::npos;
}

// one draw compared with the table's entry of an opening
void add(DrawsAgree& sum, const DrawRow& row, const OpeningRow& said, double weight) {
  sum.draws += weight;
  sum.roof += weight * (row.words[0] != "-");
  sum.roof_kind += weight * row.words[0].starts_with(kind_word(said.first));
  sum.roof_sets += weight * holds(row.roof_kind, said.first);
  sum.second_place += weight * holds(row.second_place, said.second);
  sum.second_kind += weight * holds(row.second_kind, said.second);
}

// "wedge 80W/40E 3, fall 1": the most frequent first
std::string counted(const std::vector<std::string>& all) {
  std::map<std::string, int> count;
  for (const std::string& words : all)
    ++count[words];
  std::vector<std::pair<std::string, int>> order(count.begin(), count.end());
  std::ranges::stable_sort(order, [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text;
  for (const auto& [words, times] : order)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", words, times);
  return text;
}

std::string roofs(const std::vector<DrawRow>& rows, int number) {
  std::vector<std::string> all;
  for (const DrawRow& row : rows)
    if (row.number == number) all.push_back(row.words[0] == "-" ? "holds" : row.words[0]);
  return counted(all);
}

// of both; walls that lose little are omitted
std::string walls(const std::vector<DrawRow>& rows, int number) {
  std::vector<std::string> all;
  for (const DrawRow& row : rows)
    for (const int wall : {1, 2})
      if (row.number == number && row.area[wall] >= minor_area) all.push_back(row.words[wall]);
  return all.empty() ? "-" : counted(all);
}

double mean_area(const std::vector<DrawRow>& rows, int number, int place) {
  double sum = 0;
  int draws = 0;
  for (const DrawRow& row : rows)
    if (row.number == number) {
      sum += row.area[place];
      ++draws;
    }
  return sum / draws;
}

std::string sets(const OpeningRow& row) {
  std::string text;
  for (const int dip : row.dips)
    text += fmt::format("{}{} ", std::abs(dip), dip > 0 ? "E" : "W");
  return text + fmt::format("{}°", row.friction);
}

std::string sum_line(const std::string& name, const DrawsAgree& sum, const char* format) {
  const auto share = [&](double number) { return fmt::format(fmt::runtime(format), number); };
  return fmt::format("| {} | | | | {} | {} | {} | {} | {} | | | |\n", name, share(sum.roof), share(sum.roof_kind),
                     share(sum.roof_sets), share(sum.second_place), share(sum.second_kind));
}

}  // namespace

DrawRow draw_row(const Opening& opening, int draw, const std::string& inputs) {
  DrawRow row;
  row.number = opening.row.number;
  row.draw = draw;
  for (int place = 0; place < 4; ++place) {
    row.words[place] = words(opening, static_cast<reference::Place>(place));
    row.area[place] = opening.found[place].area;
  }
  const std::string firsts = first_letters, seconds = second_letters;
  for (const char letter : firsts)
    if (agreement(opening, letter, '-').roof_kind) row.roof_kind += letter;
  for (const char letter : seconds) {
    const Agreement agrees = agreement(opening, 'W', letter);
    if (agrees.second_place) row.second_place += letter;
    if (agrees.second_kind) row.second_kind += letter;
  }
  row.above_springline = opening.above_springline;
  row.farthest = opening.farthest;
  row.evaluations = opening.evaluations;
  row.inputs = inputs;
  return row;
}

std::string draws_csv(const std::vector<DrawRow>& rows) {
  std::string text = "number,draw";
  for (const std::string& place : places)
    text += fmt::format(",{0},{0}_m2", place);
  text +=
      ",roof_kind_fits,second_place_fits,second_kind_fits,above_springline_m2,farthest_m,contact_evaluations,inputs\n";
  for (const DrawRow& row : rows) {
    text += fmt::format("{},{}", row.number, row.draw);
    for (int place = 0; place < 4; ++place)
      text += "," + csv_cell(row.words[place]) + "," + csv_cell(row.area[place]);
    for (const std::string& letters : {row.roof_kind, row.second_place, row.second_kind})
      text += "," + csv_cell(letters);
    text += fmt::format(",{},{},{},{}\n", csv_cell(row.above_springline), csv_cell(row.farthest), row.evaluations,
                        csv_cell(row.inputs));
  }
  return text;
}

std::vector<DrawRow> read_draws(const std::string& csv) {
  const CsvTable table = parse_csv(csv);
  std::vector<DrawRow> rows;
  for (const CsvRow& line : table.rows) {
    DrawRow row;
    row.number = static_cast<int>(table.required_number(line, "number"));
    row.draw = static_cast<int>(table.required_number(line, "draw"));
    if (row.number < 1 || row.number > static_cast<int>(opening_rows().size()))
      table.refuse(line, "number", "there is no such opening");
    for (int place = 0; place < 4; ++place) {
      row.words[place] = table.text(line, places[place]);
      row.area[place] = table.required_number(line, places[place] + "_m2");
    }
    row.roof_kind = table.text(line, "roof_kind_fits");
    row.second_place = table.text(line, "second_place_fits");
    row.second_kind = table.text(line, "second_kind_fits");
    row.above_springline = table.required_number(line, "above_springline_m2");
    row.farthest = table.required_number(line, "farthest_m");
    row.evaluations = static_cast<long long>(table.required_number(line, "contact_evaluations"));
    row.inputs = table.text(line, "inputs");
    rows.push_back(row);
  }
  return rows;
}

DrawsAgree draws_agree(const std::vector<DrawRow>& rows, int number) {
  DrawsAgree sum;
  for (const DrawRow& row : rows)
    if (row.number == number) add(sum, row, opening_rows()[number - 1], 1);
  return sum;
}

DrawsAgree by_chance(const std::vector<DrawRow>& rows) {
  DrawsAgree sum;
  const double weight = 1 / (static_cast<double>(opening_rows().size()) - 1);
  for (const DrawRow& row : rows)
    for (const OpeningRow& said : opening_rows())
      if (said.number != row.number) add(sum, row, said, weight);
  return sum;
}

std::string agreement_table(const std::vector<DrawRow>& rows) {
  std::string text =
      "| no. | sets, φ | thesis: roof; besides | draws | roof fails | roof: kind | and sets | besides: place | "
      "and kind | roof, ours | walls, ours | roof, left, right, m² "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  DrawsAgree all;
  for (const OpeningRow& said : opening_rows()) {
    const DrawsAgree one = draws_agree(rows, said.number);
    if (one.draws == 0) continue;
    for (const DrawRow& row : rows)
      if (row.number == said.number) add(all, row, said, 1);
    text += fmt::format("| {} | {} | {} | {:.0f} | {:.0f} | {:.0f} | {:.0f} | {:.0f} | {:.0f} ", said.number,
                        sets(said), published(said), one.draws, one.roof, one.roof_kind, one.roof_sets,
                        one.second_place, one.second_kind);
    text +=
        fmt::format("| {} | {} | {:.1f}, {:.1f}, {:.1f} |\n", roofs(rows, said.number), walls(rows, said.number),
                    mean_area(rows, said.number, 0), mean_area(rows, said.number, 1), mean_area(rows, said.number, 2));
  }
  text += sum_line(fmt::format("all {:.0f}", all.draws), all, "{:.0f}");
  return text + sum_line("by chance", by_chance(rows), "{:.1f}");
}

}  // namespace voussoir::cases
