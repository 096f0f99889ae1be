// The tornado diagram of a table of derivatives, as SVG.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/derivatives/derivative_files.hpp"

namespace voussoir {
namespace {

constexpr std::size_t most_bars = 15;
constexpr double row_height = 24, bar_height = 16, top = 64, bottom = 56;  // px
constexpr double plot_width = 420, side_margin = 16, letter = 7.3;         // px; a letter of 12 px
constexpr const char *up_fill = "#0072b2", *down_fill = "#e69f00";

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text)
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else
      safe += c;
  return safe;
}

// the change of the answer when the key goes up, or down, by its usual change; none on a side without a derivative
double bar_to(const DerivativeRow& row, bool up) {
  const Derivative& found = row.derivative;
  if (found.one_side && !(up ? found.above : found.below).value) return 0;
  const double slope = found.value ? *found.value : up ? *found.above.value : *found.below.value;
  return (up ? 1 : -1) * slope * row.key.usual;
}

// 1, 2 or 5 times a power of ten, for about three intervals
double tick_of(double half_range) {
  const double power = std::pow(10, std::floor(std::log10(half_range / 3)));
  for (const double times : {1.0, 2.0, 5.0})
    if (times * power * 4.2 >= half_range) return times * power;
  return 10 * power;
}

std::string label_of(const DerivativeRow& row) {
  const std::size_t space = row.key.shown_unit.find(' ');
  const double number = space == std::string::npos ? 1 : std::stod(row.key.shown_unit);
  const std::string unit = space == std::string::npos ? row.key.shown_unit : row.key.shown_unit.substr(space + 1);
  return fmt::format("{} ± {:.3g}{}", row.key.key, number * row.key.usual / row.key.shown,
                     unit == "1" ? "" : " " + unit);
}

// "least factor" of "least_factor"
std::string name_in_words(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

// characters, not bytes
std::size_t letters_of(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace

std::string derivatives_svg(const DerivativeTable& table) {
  std::vector<const DerivativeRow*> rows;
  for (const DerivativeRow& row : table.rows)
    if (!row.refused && rows.size() < most_bars) rows.push_back(&row);
  std::size_t longest = 12;
  double largest = 0;
  for (const DerivativeRow* row : rows) {
    longest = std::max(longest, letters_of(label_of(*row)));
    largest = std::max({largest, std::abs(bar_to(*row, true)), std::abs(bar_to(*row, false))});
  }
  const std::string title =
      table.base.value ? fmt::format("What moves the {}, {:.5g}{}", name_in_words(table.answer.name), *table.base.value,
                                     table.answer.unit == "1" ? "" : " " + table.answer.unit)
                       : "What moves the answer: no answer, so no derivative";
  const double left = side_margin + letter * static_cast<double>(longest) + 10;
  const double plot_height = row_height * static_cast<double>(rows.size());
  const double width =
                   std::max(left + plot_width + side_margin, 2 * side_margin + 9 * static_cast<double>(title.size())),
               height = top + plot_height + bottom;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "font-family=\"DejaVu Sans,Helvetica,Arial,sans-serif\" font-size=\"12\" fill=\"#202020\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n<text x=\"{2}\" y=\"22\" font-size=\"15\">{3}</text>\n",
      width, height, side_margin, escaped(title));
  if (rows.empty() || !(largest > 0)) return svg + "</svg>\n";
  svg += fmt::format(
      "<rect x=\"{0}\" y=\"36\" width=\"12\" height=\"12\" fill=\"{1}\"/><text x=\"{2}\" y=\"46\">the "
      "number goes up</text>\n<rect x=\"{3}\" y=\"36\" width=\"12\" height=\"12\" fill=\"{4}\"/>"
      "<text x=\"{5}\" y=\"46\">the number goes down</text>\n",
      side_margin, up_fill, side_margin + 18, side_margin + 160, down_fill, side_margin + 178);
  const double tick = tick_of(largest), half = 1.08 * largest;
  const auto at = [&](double change) { return left + plot_width * (0.5 + 0.5 * change / half); };
  const int last = static_cast<int>(std::floor(half / tick));
  for (int k = -last; k <= last; ++k)
    svg += fmt::format(
        "<line x1=\"{0:.2f}\" y1=\"{1}\" x2=\"{0:.2f}\" y2=\"{2}\" stroke=\"{3}\"/><text x=\"{0:.2f}\" "
        "y=\"{4}\" text-anchor=\"middle\">{5}</text>\n",
        at(k * tick), top, top + plot_height, k == 0 ? "#606060" : "#e0e0e0", top + plot_height + 17,
        k == 0 ? "0" : fmt::format("{:+.3g}", k * tick));
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double y = top + row_height * static_cast<double>(k) + 0.5 * (row_height - bar_height);
    svg += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"end\">{}</text>\n", left - 8, y + 12.5,
                       escaped(label_of(*rows[k])));
    for (const bool up : {true, false}) {
      const double from = at(0), to = at(bar_to(*rows[k], up));
      // at a kink both may go to the same side: each takes half of the height then
      const bool halves = bar_to(*rows[k], true) * bar_to(*rows[k], false) > 0;
      svg += fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n",
                         std::min(from, to), y + (halves && !up ? 0.5 * bar_height : 0), std::abs(to - from),
                         halves ? 0.5 * bar_height : bar_height, up ? up_fill : down_fill);
    }
  }
  return svg + fmt::format(
                   "<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\">change of the {}{}, by the "
                   "derivative</text>\n</svg>\n",
                   at(0), top + plot_height + 40, escaped(name_in_words(table.answer.name)),
                   table.answer.unit == "1" ? "" : ", " + escaped(table.answer.unit));
}

}  // namespace voussoir
