// Pictures of solids in parallel projection: shaded faces that gnuplot fills from back to front.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/geometry/types.hpp"
#include "text/angle.hpp"
#include "verification/case_report.hpp"

namespace voussoir::cases {

// direction of the eye, and its right and up directions
struct View {
  Vector<3> eye, right, up, light;

  // from x and from the horizontal
  View(double azimuth_deg, double height_deg) {
    const double azimuth = azimuth_deg * degree, height = height_deg * degree;
    eye = {std::cos(height) * std::cos(azimuth), std::cos(height) * std::sin(azimuth), std::sin(height)};
    right = Vector<3>::UnitZ().cross(eye).normalized();
    up = eye.cross(right);
    light = (eye + 0.7 * up - 0.5 * right).normalized();
  }
};

struct PictureFace {
  double depth = 0;                            // larger is nearer to the eye
  std::uint32_t colour = 0;                    // rgb
  std::vector<std::array<double, 2>> outline;  // to the right and up, m
};

// a face with these corners, whose colour is darker if it faces away from the light
inline PictureFace shaded_face(const View& view, const std::vector<Vector<3>>& corners, const Vector<3>& normal,
                               std::uint32_t base) {
  PictureFace face;
  for (const Vector<3>& v : corners) {
    face.outline.push_back({v.dot(view.right), v.dot(view.up)});
    face.depth += v.dot(view.eye) / static_cast<double>(corners.size());
  }
  const double shade = 0.55 + 0.45 * std::max(0.0, normal.dot(view.light));
  for (int shift = 0; shift < 24; shift += 8)
    face.colour |= static_cast<std::uint32_t>(shade * ((base >> shift) & 0xff)) << shift;
  return face;
}

inline void put_in_order(std::vector<PictureFace>& faces) {
  std::stable_sort(faces.begin(), faces.end(),
                   [](const PictureFace& a, const PictureFace& b) { return a.depth < b.depth; });
}

// As CSV: right_m, up_m, colour (rgb as a number); a face is a closed line, faces are separated by a blank line.
// gnuplot fills all of them before it draws an edge, so such a picture has no edges.
inline void write_faces(const std::string& case_name, const std::string& file, std::vector<PictureFace> faces) {
  put_in_order(faces);
  std::ofstream out(verification::case_output(case_name) / file);
  out.precision(6);
  out << "right_m,up_m,colour\n";
  for (const PictureFace& face : faces) {
    for (std::size_t i = 0; i <= face.outline.size(); ++i) {
      const auto& [right, up] = face.outline[i % face.outline.size()];
      out << right << ',' << up << ',' << face.colour << '\n';
    }
    out << '\n';
  }
  if (!out) throw std::runtime_error("cannot write " + file);
}

// As gnuplot objects with edges, to be loaded; the ranges that they need are right_min, right_max, up_min, up_max.
inline void write_objects(const std::string& case_name, const std::string& file, std::vector<PictureFace> faces) {
  put_in_order(faces);
  std::array<double, 2> low{1e300, 1e300}, high{-1e300, -1e300};
  std::ofstream out(verification::case_output(case_name) / file);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    out << "set object " << i + 1 << " polygon from ";
    const auto& outline = faces[i].outline;
    for (std::size_t k = 0; k <= outline.size(); ++k) {
      const auto& p = outline[k % outline.size()];
      out << fmt::format("{}{:.5g},{:.5g}", k == 0 ? "" : " to ", p[0], p[1]);
      for (int axis = 0; axis < 2; ++axis) {
        low[axis] = std::min(low[axis], p[axis]);
        high[axis] = std::max(high[axis], p[axis]);
      }
    }
    out << fmt::format(" fs solid border rgb '#4a4a4a' fc rgb '#{:06x}' lw 0.5\n", faces[i].colour);
  }
  out << fmt::format("right_min = {}\nright_max = {}\nup_min = {}\nup_max = {}\n", low[0], high[0], low[1], high[1]);
  if (!out) throw std::runtime_error("cannot write " + file);
}

}  // namespace voussoir::cases
