// Small figures in the look of the manual's (reports/style.gp), drawn without gnuplot: byte for byte the same anywhere.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace voussoir {

using Points = std::vector<std::pair<double, double>>;

struct Curve {
  enum class Kind { line, steps, points };
  Kind kind = Kind::line;
  std::string title;
  Points points;  // steps: left edge of each bin and its height, at last the right edge and any height
};

struct Diagram {
  std::string title, x_label, y_label;
  bool logarithmic_x = false;  // points at or left of 0 are left out
  std::vector<Curve> curves;   // in the colours of Okabe & Ito (2008), in this order
  bool from_zero = true;       // y; else from the lowest point
};

// axes with round numbers that include every point
std::string svg(const Diagram& diagram);

enum class MapMark { none, cross, ring };

// A field of cells, one for each pair of values; axes name the values, which may be texts and at any distance.
struct MapFigure {
  std::string title, x_label, y_label, value_label;
  std::string mark_label, ring_label;  // of crosses and rings; empty: they are not explained
  std::vector<std::string> x, y;
  std::vector<std::optional<double>> values;  // of each cell, x changing fastest; nothing: grey
  std::vector<MapMark> marks;
};

// y rises upwards
std::string svg_map(const MapFigure& figure);

struct PoleSet {
  std::string title;
  std::vector<std::pair<double, double>> poles;  // trend (clockwise from north) and plunge (below horizontal), rad
};

// Lower hemisphere, equal area (Schmidt): a pole of plunge p is at sqrt(2) sin((90° - p)/2) of the radius from the
// centre.
std::string stereonet_svg(const std::string& title, const std::vector<PoleSet>& sets);

}  // namespace voussoir
