#include "reference/vaiont/slide_in_space.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace voussoir::reference {

double DippingPlane::elevation(double x, double y) const {
  const double slope = std::tan(dip * std::numbers::pi / 180), azimuth = dip_direction * std::numbers::pi / 180;
  return point[2] - slope * (std::sin(azimuth) * (x - point[0]) + std::cos(azimuth) * (y - point[1]));
}

SlideInSpace vaiont_in_space(double east) {
  const double south = 0, north = 2200;
  return {.west = 780,
          .east = east,
          .south = south,
          .north = north,
          .slide = {{38, 9.5, {1163, 1575, 644}},
                    {43, 353, {2172, 689, 1480}},
                    {19.5, 80, {1163, 1876, 620}},
                    {10, 80, {1735, 1876, 545}}},
          .ground = {{780, 1350, south, 1549, {{23, 0, {1089, 1215, 1080}}, {33, 0, {1163, 1540, 870}}}},
                     {780, 1350, 1549, 1769, {{0, 0, {1163, 1769, 860}}}},
                     {780, 1350, 1769, north, {{38, 0, {1163, 1769, 860}}}},
                     {1350, 1557, south, 1549, {{27, 20, {1452, 1529, 850}}}},
                     {1557, 1724, south, 1549, {{22, 0, {1632, 1529, 830}}}},
                     {1724, 2172, south, 1649, {{28, 340, {1822, 1529, 800}}}},
                     {1350, 2172, 1549, north, {{0, 0, {1622, 1769, 830}}}},
                     {1350, 2172, 1600, north, {{40, 8, {1622, 1769, 830}}}},
                     {2172,
                      east,
                      south,
                      north,
                      {{30, 0, {2689, 689, 1380}}, {34, 10, {3589, 689, 1350}}, {55, 5, {2400, 2040, 500}}}}},
          .gorge = {85, 0, {1653, 2130, 590}}};
}

namespace {

// midpoints of cells no wider than `spacing`, none of which crosses one of these borders
struct Cells {
  std::vector<double> middle, width;
};

Cells cells_between(std::vector<double> borders, double spacing) {
  std::sort(borders.begin(), borders.end());
  Cells cells;
  for (std::size_t k = 0; k + 1 < borders.size(); ++k) {
    const double from = borders[k], length = borders[k + 1] - from;
    const int count = static_cast<int>(std::ceil(length / spacing));
    for (int i = 0; i < count; ++i) {
      cells.middle.push_back(from + (i + 0.5) / count * length);
      cells.width.push_back(length / count);
    }
  }
  return cells;
}

}  // namespace

SlideVolumes slide_volumes(const SlideInSpace& slide, double spacing, double elevation) {
  std::vector<double> east{slide.west, slide.east}, north{slide.south, slide.north};
  for (const GroundStrip& strip : slide.ground) {
    east.insert(east.end(), {strip.west, strip.east});
    north.insert(north.end(), {strip.south, strip.north});
  }
  const Cells columns = cells_between(east, spacing), rows = cells_between(north, spacing);
  SlideVolumes sum;
  for (std::size_t i = 0; i < columns.middle.size(); ++i)
    for (std::size_t j = 0; j < rows.middle.size(); ++j) {
      const double x = columns.middle[i], y = rows.middle[j], cell = columns.width[i] * rows.width[j];
      double floor = -std::numeric_limits<double>::infinity(), top = slide.gorge.elevation(x, y);
      for (const DippingPlane& plane : slide.slide)
        floor = std::max(floor, plane.elevation(x, y));
      for (const GroundStrip& strip : slide.ground)
        if (x >= strip.west && x < strip.east && y >= strip.south && y < strip.north)
          for (const DippingPlane& plane : strip.planes)
            top = std::min(top, plane.elevation(x, y));
      if (top <= floor) continue;
      sum.all += (top - floor) * cell;
      sum.below += std::max(0.0, std::min(top, elevation) - floor) * cell;
      sum.plan += cell;
      sum.thickest = std::max(sum.thickest, top - floor);
    }
  return sum;
}

}  // namespace voussoir::reference
