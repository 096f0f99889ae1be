// Small figures in the look of the manual's (reports/style.gp), drawn without gnuplot: byte for byte the same anywhere.
#pragma once

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
};

// axes with round numbers that hold every point; y begins at 0
std::string svg(const Diagram& diagram);

struct PoleSet {
  std::string title;
  std::vector<std::pair<double, double>> poles;  // trend (clockwise from north) and plunge (below horizontal), rad
};

// Lower hemisphere, equal area (Schmidt): a pole of plunge p lies sqrt(2) sin((90° - p)/2) of the radius from the
// centre.
std::string stereonet_svg(const std::string& title, const std::vector<PoleSet>& sets);

}  // namespace voussoir
