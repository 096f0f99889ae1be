// The figure of error against cost.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/judge/judgement_text.hpp"

namespace voussoir {
namespace {

constexpr double figure_width = 720, figure_height = 460, left_margin = 70, right_margin = 200, top_margin = 20,
                 bottom_margin = 50;  // px
constexpr double least_error = 1e-3;  // tolerances: nearer to the truth is drawn there
constexpr std::array colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#000000", "#8a6d3b"};

struct Mark {
  double seconds, error;  // s; tolerances
  std::size_t code, problem;
};

// decades that contain all values
struct Decades {
  int low = 0, high = 1;

  double at(double value) const { return (std::log10(value) - low) / (high - low); }
};

Decades decades_of(const std::vector<Mark>& marks, double Mark::*member) {
  Decades d{100, -100};
  for (const Mark& mark : marks) {
    d.low = std::min(d.low, static_cast<int>(std::floor(std::log10(mark.*member))));
    d.high = std::max(d.high, static_cast<int>(std::ceil(std::log10(mark.*member) + 1e-9)));
  }
  if (d.high == d.low) ++d.high;
  return d;
}

std::string shape(std::size_t problem, double x, double y, const char* colour) {
  constexpr double r = 4.5;
  switch (problem % 4) {
    case 0:
      return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"", x, y, r, colour);
    case 1:
      return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\" fill=\"{}\"", x - r, y - r, 2 * r,
                         2 * r, colour);
    case 2:
      return fmt::format("<path d=\"M{:.1f} {:.1f}l{r} {r2}h-{r2}z\" fill=\"{c}\"", x, y - r, fmt::arg("r", r),
                         fmt::arg("r2", 2 * r), fmt::arg("c", colour));
    default:
      return fmt::format("<path d=\"M{:.1f} {:.1f}l{r} {r}l-{r} {r}l-{r} -{r}z\" fill=\"{c}\"", x, y - r,
                         fmt::arg("r", r), fmt::arg("c", colour));
  }
}

}  // namespace

std::string error_against_cost(const Judgement& judgement) {
  std::vector<std::string> problems;
  std::vector<Mark> marks;
  for (const JudgedRow& row : judgement.rows) {
    if (!row.error || !row.seconds || !(*row.seconds > 0) || !row.tolerance) continue;
    if (std::ranges::find(problems, row.problem) == problems.end()) problems.push_back(row.problem);
    const auto problem = std::ranges::find(problems, row.problem) - problems.begin();
    const auto code = std::ranges::find(judgement.codes, row.code) - judgement.codes.begin();
    const double beyond = *row.tolerance > 0 ? std::abs(*row.error) / *row.tolerance : *row.error == 0 ? 0 : 1e3;
    marks.push_back({*row.seconds, std::max(least_error, beyond), static_cast<std::size_t>(code),
                     static_cast<std::size_t>(problem)});
  }
  if (marks.empty()) return {};
  const Decades seconds = decades_of(marks, &Mark::seconds), errors = decades_of(marks, &Mark::error);
  const double width = figure_width - left_margin - right_margin, height = figure_height - top_margin - bottom_margin;
  const auto x_of = [&](double s) { return left_margin + width * seconds.at(s); };
  const auto y_of = [&](double e) { return top_margin + height * (1 - errors.at(e)); };
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"{0}\" "
      "height=\"{1}\" fill=\"white\"/>\n",
      figure_width, figure_height);
  for (int k = seconds.low; k <= seconds.high; ++k)
    text += fmt::format(
        "<path d=\"M{0:.1f} {1:.1f}V{2:.1f}\" stroke=\"#ddd\"/><text x=\"{0:.1f}\" y=\"{3:.1f}\" "
        "text-anchor=\"middle\">{4:g}</text>\n",
        x_of(std::pow(10, k)), top_margin, top_margin + height, top_margin + height + 16, std::pow(10, k));
  for (int k = errors.low; k <= errors.high; ++k)
    text += fmt::format(
        "<path d=\"M{0:.1f} {1:.1f}H{2:.1f}\" stroke=\"{5}\"/><text x=\"{3:.1f}\" y=\"{1:.1f}\" "
        "text-anchor=\"end\">{4:g}</text>\n",
        left_margin, y_of(std::pow(10, k)), left_margin + width, left_margin - 6, std::pow(10, k),
        k == 0 ? "#c00" : "#ddd");
  text += fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">processor time, s</text>\n<text x=\"16\" "
      "y=\"{:.1f}\" transform=\"rotate(-90 16 {:.1f})\" text-anchor=\"middle\">error, tolerances</text>\n",
      left_margin + width / 2, figure_height - 12, top_margin + height / 2, top_margin + height / 2);
  for (const Mark& mark : marks)
    text += shape(mark.problem, x_of(mark.seconds), y_of(mark.error), colours[mark.code % colours.size()]) +
            fmt::format(" fill-opacity=\"0.8\"><title>{} {}</title>{}\n", problems[mark.problem], mark.code + 1,
                        mark.problem % 4 == 0   ? "</circle>"
                        : mark.problem % 4 == 1 ? "</rect>"
                                                : "</path>");
  double y = top_margin + 10;
  const auto label = [&](const std::string& mark, const std::string& name) {
    text += mark + fmt::format("/><text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", left_margin + width + 28, y + 4, name);
    y += 17;
  };
  const double at = left_margin + width + 16;
  for (std::size_t k = 0; k < judgement.codes.size(); ++k) {
    std::string name;
    for (const char c : judgement.codes[k])
      name += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
    label(shape(0, at, y, colours[k % colours.size()]), name);
  }
  y += 10;
  for (std::size_t k = 0; k < problems.size(); ++k)
    label(shape(k, at, y, "#999"), problems[k]);
  return text + "</svg>\n";
}

}  // namespace voussoir
