#include "app/base/svg_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/output/vtp.hpp"

namespace voussoir {
namespace {

constexpr const char* colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#404040"};

constexpr double paper_width = 760, paper_height = 460;                                   // as the manual's figures
constexpr double frame_left = 80, frame_right = 730, frame_top = 70, frame_bottom = 400;  // the frame
constexpr double middle_x = 260, middle_y = 245, net_radius = 185;                        // of a stereonet

const char* colour(std::size_t i) {
  return colours[i % std::size(colours)];
}

std::string head(const std::string& title) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
      "font-family=\"DejaVu Sans,Helvetica,Arial,sans-serif\" font-size=\"13\" fill=\"#202020\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n"
      "<text x=\"{2}\" y=\"24\" text-anchor=\"middle\" font-size=\"15\">{3}</text>\n",
      paper_width, paper_height, paper_width / 2, xml_escaped(title));
}

std::string label(double x, double y, const char* anchor, const std::string& text, const std::string& more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, more,
                     xml_escaped(text));
}

std::string stroke(double x1, double y1, double x2, double y2, const char* colour, double thickness) {
  return fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" stroke-width=\"{}\"/>\n", x1, y1, x2,
      y2, colour, thickness);
}

// an axis from value to place on the paper
struct Axis {
  double low = 0, high = 1, from = 0, to = 1;
  bool logarithmic = false;
  std::vector<double> tics;

  double place(double x) const {
    const double fraction = logarithmic ? std::log(x / low) / std::log(high / low) : (x - low) / (high - low);
    return from + fraction * (to - from);
  }
};

// 1, 2 or 5 times a power of ten, some five of them to the span
Axis linear_axis(double low, double high, double from, double to) {
  if (!(high > low)) high = low + 1;
  const double rough = (high - low) / 5, decade = std::pow(10, std::floor(std::log10(rough)));
  const double step = decade * (rough / decade < 1.5 ? 1 : rough / decade < 3.5 ? 2 : rough / decade < 7.5 ? 5 : 10);
  Axis axis{std::floor(low / step) * step, std::ceil(high / step) * step, from, to, false, {}};
  const auto count = static_cast<int>(std::round((axis.high - axis.low) / step));
  for (int k = 0; k <= count; ++k)
    axis.tics.push_back(axis.low + k * step);
  return axis;
}

Axis logarithmic_axis(double low, double high, double from, double to) {
  const double first = std::floor(std::log10(low)), last = std::max(first + 1, std::ceil(std::log10(high)));
  Axis axis{std::pow(10, first), std::pow(10, last), from, to, true, {}};
  for (double e = first; e <= last; ++e)
    axis.tics.push_back(std::pow(10, e));
  return axis;
}

std::string number(double x) {
  return fmt::format("{:.6g}", x);
}

std::string frame(const Diagram& diagram, const Axis& x, const Axis& y) {
  std::string text;
  for (const double tic : x.tics)
    text += stroke(x.place(tic), frame_bottom, x.place(tic), frame_top, "#e2e2e2", 1) +
            label(x.place(tic), frame_bottom + 20, "middle", number(tic));
  for (const double tic : y.tics)
    text += stroke(frame_left, y.place(tic), frame_right, y.place(tic), "#e2e2e2", 1) +
            label(frame_left - 8, y.place(tic) + 4, "end", number(tic));
  text += stroke(frame_left, frame_bottom, frame_right, frame_bottom, "#606060", 1) +
          stroke(frame_left, frame_bottom, frame_left, frame_top, "#606060", 1);
  text += label((frame_left + frame_right) / 2, paper_height - 18, "middle", diagram.x_label);
  const double across = (frame_top + frame_bottom) / 2;
  return text + label(22, across, "middle", diagram.y_label, fmt::format(" transform=\"rotate(-90 22 {})\"", across));
}

std::string drawn(const Curve& curve, const Axis& x, const Axis& y, const char* colour) {
  std::string text;
  Points places;
  for (const auto& [px, py] : curve.points)
    if (!x.logarithmic || px > 0) places.emplace_back(x.place(px), y.place(py));
  if (curve.kind == Curve::Kind::points) {
    for (const auto& [px, py] : places)
      text += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.5\" fill=\"{}\"/>\n", px, py, colour);
    return text;
  }
  if (places.empty()) return text;
  std::string path = fmt::format("M{:.1f} {:.1f}", places[0].first, places[0].second);
  for (std::size_t k = 1; k < places.size(); ++k) {
    if (curve.kind == Curve::Kind::steps) path += fmt::format("H{:.1f}", places[k].first);
    path += fmt::format("L{:.1f} {:.1f}", places[k].first, places[k].second);
  }
  return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n", path, colour);
}

// from low to high, readable without colour too: the lightness rises evenly (viridis, five of its colours)
std::string shade(double fraction) {
  constexpr int stops[][3] = {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}};
  const double at = std::clamp(fraction, 0.0, 1.0) * 4;
  const int k = std::min(3, static_cast<int>(at));
  const auto mix = [&](int c) {
    return static_cast<int>(std::lround(stops[k][c] + (at - k) * (stops[k + 1][c] - stops[k][c])));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(0), mix(1), mix(2));
}

std::string rectangle(double x, double y, double wide, double high, const std::string& fill) {
  return fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\" "
      "shape-rendering=\"crispEdges\"/>\n",
      x, y, wide, high, fill);
}

std::string cross(double x, double y, double half) {
  return stroke(x - half, y - half, x + half, y + half, colours[1], 2) +
         stroke(x - half, y + half, x + half, y - half, colours[1], 2);
}

std::string ring(double x, double y, double radius) {
  return fmt::format(
      "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n", x, y,
      radius, colours[1]);
}

std::string drawn_mark(MapMark mark, double x, double y, double half) {
  if (mark == MapMark::none) return "";
  return mark == MapMark::cross ? cross(x, y, half) : ring(x, y, half);
}

// the scale next to a map, with the marks that it uses
std::string map_legend(const MapFigure& figure, double low, double high) {
  constexpr double x = 620, wide = 20, steps = 50;
  std::string text;
  for (int k = 0; k < steps; ++k)
    text += rectangle(x, frame_bottom - (k + 1) * (frame_bottom - frame_top) / steps, wide,
                      (frame_bottom - frame_top) / steps + 0.5, shade(k / (steps - 1)));
  text += label(x + wide + 6, frame_bottom, "start", number(low)) +
          label(x + wide + 6, frame_top + 10, "start", number(high));
  text += label(x + wide / 2, frame_top - 12, "middle", figure.value_label);
  if (!figure.mark_label.empty())
    text += cross(frame_left + 6, 44, 5) + label(frame_left + 18, 48, "start", figure.mark_label);
  if (!figure.ring_label.empty())
    text += ring(frame_left + 246, 44, 5) + label(frame_left + 258, 48, "start", figure.ring_label);
  return text;
}

}  // namespace

std::string svg(const Diagram& diagram) {
  constexpr double none = std::numeric_limits<double>::infinity();
  double low = none, high = -none, lowest = diagram.from_zero ? 0 : none, highest = 0;
  for (const Curve& curve : diagram.curves)
    for (const auto& [px, py] : curve.points) {
      if (diagram.logarithmic_x && !(px > 0)) continue;
      low = std::min(low, px);
      high = std::max(high, px);
      lowest = std::min(lowest, py);
      highest = std::max(highest, py);
    }
  if (!(low <= high)) low = high = 1;
  const Axis x = diagram.logarithmic_x ? logarithmic_axis(low, high, frame_left, frame_right)
                                       : linear_axis(low, high, frame_left, frame_right);
  const Axis y = linear_axis(std::min(lowest, highest), highest, frame_bottom, frame_top);

  std::string text = head(diagram.title) + frame(diagram, x, y);
  const double fraction =
      (frame_right - frame_left) / static_cast<double>(std::max<std::size_t>(1, diagram.curves.size()));
  for (std::size_t i = 0; i < diagram.curves.size(); ++i) {
    text += drawn(diagram.curves[i], x, y, colour(i));
    const double at = frame_left + fraction * static_cast<double>(i);
    text += stroke(at, 48, at + 24, 48, colour(i), 2) + label(at + 30, 52, "start", diagram.curves[i].title);
  }
  return text + "</svg>\n";
}

std::string svg_map(const MapFigure& figure) {
  constexpr double map_right = 590;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const std::optional<double>& value : figure.values)
    if (value) {
      low = std::min(low, *value);
      high = std::max(high, *value);
    }
  if (!(low <= high)) low = high = 0;
  const auto nx = static_cast<double>(figure.x.size()), ny = static_cast<double>(figure.y.size());
  const double wide = (map_right - frame_left) / nx, tall = (frame_bottom - frame_top) / ny;
  std::string text = head(figure.title);
  for (std::size_t k = 0; k < figure.values.size(); ++k) {
    const double x = frame_left + wide * static_cast<double>(k % figure.x.size());
    const double y = frame_bottom - tall * static_cast<double>(k / figure.x.size() + 1);
    const std::optional<double>& value = figure.values[k];
    text += rectangle(x, y, wide, tall, value ? shade(high > low ? (*value - low) / (high - low) : 0.5) : "#d0d0d0");
    text += drawn_mark(figure.marks[k], x + wide / 2, y + tall / 2, std::min({6.0, wide / 3, tall / 3}));
  }
  // no more names than there is room for
  const auto every = [](double size, double room) {
    return static_cast<std::size_t>(std::max(1.0, std::ceil(room / size)));
  };
  for (std::size_t k = 0; k < figure.x.size(); k += every(wide, 50))
    text += label(frame_left + wide * (static_cast<double>(k) + 0.5), frame_bottom + 20, "middle", figure.x[k]);
  for (std::size_t k = 0; k < figure.y.size(); k += every(tall, 14))
    text += label(frame_left - 8, frame_bottom - tall * (static_cast<double>(k) + 0.5) + 4, "end", figure.y[k]);
  text += label((frame_left + map_right) / 2, paper_height - 18, "middle", figure.x_label);
  const double across = (frame_top + frame_bottom) / 2;
  text += label(22, across, "middle", figure.y_label, fmt::format(" transform=\"rotate(-90 22 {})\"", across));
  return text + map_legend(figure, low, high) + "</svg>\n";
}

std::string stereonet_svg(const std::string& title, const std::vector<PoleSet>& sets) {
  constexpr std::size_t most_named = 14;  // next to the net
  std::string text = head(title);
  for (const double fraction : {1.0, 2.0 / 3, 1.0 / 3}) {
    // circles of equal plunge: 0, 30, 60 degrees
    const double radius = net_radius * std::numbers::sqrt2 * std::sin(fraction * std::numbers::pi / 4);
    text += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{:.1f}\" fill=\"none\" stroke=\"{}\"/>\n", middle_x, middle_y,
                        radius, fraction == 1 ? "#606060" : "#e2e2e2");
  }
  text += stroke(middle_x - net_radius, middle_y, middle_x + net_radius, middle_y, "#e2e2e2", 1);
  text += stroke(middle_x, middle_y - net_radius, middle_x, middle_y + net_radius, "#e2e2e2", 1);
  text += label(middle_x, middle_y - net_radius - 6, "middle", "N") +
          label(middle_x + net_radius + 6, middle_y + 4, "start", "E") +
          label(middle_x, middle_y + net_radius + 16, "middle", "S") +
          label(middle_x - net_radius - 6, middle_y + 4, "end", "W");
  for (std::size_t i = 0; i < sets.size(); ++i) {
    for (const auto& [trend, plunge] : sets[i].poles) {
      const double radius = net_radius * std::numbers::sqrt2 * std::sin((std::numbers::pi / 2 - plunge) / 2);
      text += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2\" fill=\"{}\" fill-opacity=\"0.6\"/>\n",
                          middle_x + radius * std::sin(trend), middle_y - radius * std::cos(trend), colour(i));
    }
    if (i >= most_named) continue;
    const double y = 80 + 22 * static_cast<double>(i);
    text += fmt::format("<circle cx=\"500\" cy=\"{}\" r=\"4\" fill=\"{}\"/>\n", y, colour(i)) +
            label(514, y + 4, "start", sets[i].title);
  }
  if (sets.size() > most_named)
    text += label(514, 84 + 22 * most_named, "start", fmt::format("and {} more", sets.size() - most_named));
  return text + label(500, paper_height - 20, "start", "lower hemisphere, equal area") + "</svg>\n";
}

}  // namespace voussoir
