// The number of pieces into which planes in general position cut a convex body, counted without cutting it: every
// plane, every line that two of them share and every point that three of them share adds one piece if it meets the
// body's interior (Buck 1943, Am. Math. Monthly 50; Zaslavsky 1975). Also the area that a chain of lines bounds.
#pragma once

#include <array>
#include <vector>

namespace voussoir::reference {

// a·x = offset
struct Line2 {
  std::array<double, 2> normal;
  double offset = 0;
};
struct Plane3 {
  std::array<double, 3> normal;
  double offset = 0;
};

// a box along the axes, m
template <int Dim>
struct Box {
  std::array<double, Dim> low, high;
};

// Planes that are parallel share no line. No two may coincide, and no more than two lines (three planes) may share a
// point.
long long pieces(const std::vector<Line2>& lines, const Box<2>& box);
long long pieces(const std::vector<Plane3>& planes, const Box<3>& box);

// The area inside a closed chain of lines, each of which meets the next in a corner, and the last the first.
double enclosed_area(const std::vector<Line2>& chain);

}  // namespace voussoir::reference
