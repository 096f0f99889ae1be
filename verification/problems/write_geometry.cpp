#include "verification/problems/write_geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace voussoir::problems {
namespace {

constexpr double width = 640, height = 440, margin = 50;  // px
constexpr double text_height = 13;                        // px

// to the picture's two axes and its depth, larger in front
struct View {
  Point right, up, towards;
};

View view_of(const Problem& problem) {
  if (problem.dimension == 2) return {Point::UnitX(), Point::UnitZ(), -Point::UnitY()};
  const Point towards = Point(0.55, -1, 0.5).normalized();
  const Point right = Point::UnitZ().cross(towards).normalized();
  return {right, towards.cross(right), towards};
}

struct Pixel {
  double x = 0, y = 0;
};

// fits the drawing into the picture
class Sheet {
 public:
  Sheet(const Problem& problem, const View& view) : view_(view) {
    const auto include = [&](const Point& p) {
      low_ = low_.cwiseMin(flat(p));
      high_ = high_.cwiseMax(flat(p));
    };
    for (const Solid& block : problem.blocks)
      for (const Point& v : block.vertices)
        include(v);
    for (const Dimension& d : problem.dimensions) {
      include(d.from);
      include(d.to);
    }
    const Eigen::Vector2d size = high_ - low_;
    scale_ = std::min((width - 2 * margin) / size[0], (height - 2 * margin) / size[1]);
  }
  Pixel at(const Point& p) const {
    const Eigen::Vector2d middle = 0.5 * (low_ + high_), q = flat(p) - middle;
    return {width / 2 + scale_ * q[0], height / 2 - scale_ * q[1]};
  }
  double length(double pixels) const { return pixels / scale_; }

 private:
  Eigen::Vector2d flat(const Point& p) const { return {p.dot(view_.right), p.dot(view_.up)}; }

  View view_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Constant(std::numeric_limits<double>::max());
  Eigen::Vector2d high_ = Eigen::Vector2d::Constant(std::numeric_limits<double>::lowest());
  double scale_ = 1;
};

// faces that are seen, from the farthest to the nearest
std::string faces_svg(const Problem& problem, const View& view, const Sheet& sheet) {
  struct Seen {
    double depth;
    const Solid* block;
    const Face* face;
  };
  std::vector<Seen> seen;
  for (const Solid& block : problem.blocks)
    for (const Face& face : block.faces) {
      if (face.normal.dot(view.towards) < 1e-9) continue;
      double depth = 0;
      for (const int c : face.corners)
        depth += block.vertices[c].dot(view.towards) / static_cast<double>(face.corners.size());
      seen.push_back({depth, &block, &face});
    }
  std::stable_sort(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) {
    return a.block->fixed != b.block->fixed ? a.block->fixed : a.depth < b.depth;
  });
  std::string text;
  for (const Seen& s : seen) {
    const double light = 0.75 + 0.25 * s.face->normal.dot(Point(0.3, -0.4, 0.87));
    const int shade = static_cast<int>(255 * std::clamp(light, 0.0, 1.0));
    const std::string colour = s.block->fixed
                                   ? fmt::format("rgb({0},{0},{0})", shade * 3 / 4)
                                   : fmt::format("rgb({},{},{})", shade * 9 / 10, shade * 8 / 10, shade * 6 / 10);
    text += "<polygon points=\"";
    for (const int c : s.face->corners) {
      const Pixel p = sheet.at(s.block->vertices[c]);
      text += fmt::format("{:.1f},{:.1f} ", p.x, p.y);
    }
    // free blocks are drawn over fixed ones, which let them be seen
    text += fmt::format("\" fill=\"{}\" fill-opacity=\"{}\" stroke=\"black\" stroke-width=\"0.7\"/>\n", colour,
                        problem.dimension == 3 && s.block->fixed ? 0.5 : 0.9);
  }
  return text;
}

std::string arrow(Pixel from, Pixel to, const std::string& colour, bool both, const std::string& label) {
  const double dx = to.x - from.x, dy = to.y - from.y, side = dx >= 0 ? 1 : -1;
  return fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" stroke-width=\"1.4\" "
      "marker-end=\"url(#tip)\"{}/>\n<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"{}\">{}</text>\n",
      from.x, from.y, to.x, to.y, colour, both ? " marker-start=\"url(#tip)\"" : "",
      from.x + dx / 2 + (std::abs(dy) > std::abs(dx) ? 6 : -4 * side),
      from.y + dy / 2 + (std::abs(dy) > std::abs(dx) ? 4 : -5), colour, label);
}

std::string arrows_svg(const Problem& problem, const View& view, const Sheet& sheet) {
  std::string text;
  for (const Dimension& d : problem.dimensions)
    text += arrow(sheet.at(d.from), sheet.at(d.to), "#0050a0", true, d.label);
  for (const Solid& block : problem.blocks)
    if (block.velocity.norm() > 0)
      text += arrow(sheet.at(block.centre), sheet.at(block.centre + sheet.length(60) * block.velocity.normalized()),
                    "#a03000", false, fmt::format("{:g} m/s", block.velocity.norm()));
  for (const GivenForce& f : problem.forces)
    text += arrow(sheet.at(f.point), sheet.at(f.point + sheet.length(50) * f.force.normalized()), "#a03000", false,
                  fmt::format("{:g} kN", 1e-3 * f.force.norm()));
  const Point gravity = problem.gravity.back().gravity;
  if (gravity.norm() > 0) {
    const Pixel origin{40, 40};
    const Point g = 40 * gravity.normalized();
    text += arrow(origin, {origin.x + g.dot(view.right), origin.y - g.dot(view.up)}, "#a03000", false,
                  fmt::format("g {:g} m/s²", gravity.norm()));
  }
  const Pixel origin{width - 80, height - 40};
  for (int k = 0; k < 3; ++k) {
    const Point axis = 30 * Point::Unit(k);
    if (problem.dimension == 2 && k == 1) continue;
    const Pixel end{origin.x + axis.dot(view.right), origin.y - axis.dot(view.up)};
    text += arrow(origin, end, "black", false, "");
    text += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", end.x + 3, end.y - 3, "xyz"[k]);
  }
  return text;
}

}  // namespace

std::string blocks_obj(const Problem& problem) {
  std::string text = fmt::format("# {}\n", problem.title);
  std::size_t before = 1;
  for (const Solid& block : problem.blocks) {
    text += fmt::format("o {}\n", block.name);
    for (const Point& v : block.vertices)
      text += fmt::format("v {:.17g} {:.17g} {:.17g}\n", v[0] + 0.0, v[1] + 0.0, v[2] + 0.0);
    for (const Face& face : block.faces) {
      text += "f";
      for (const int c : face.corners)
        text += fmt::format(" {}", before + static_cast<std::size_t>(c));
      text += "\n";
    }
    before += block.vertices.size();
  }
  return text;
}

std::string sketch_svg(const Problem& problem) {
  const View view = view_of(problem);
  const Sheet sheet(problem, view);
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" "
             "height=\"{1:g}\" font-family=\"sans-serif\" font-size=\"{2:g}\">\n<defs><marker id=\"tip\" "
             "viewBox=\"0 0 10 10\" refX=\"9\" refY=\"5\" markerWidth=\"7\" markerHeight=\"7\" "
             "orient=\"auto-start-reverse\"><path d=\"M0 0L10 5L0 10z\"/></marker></defs>\n<rect "
             "width=\"{0:g}\" height=\"{1:g}\" fill=\"white\"/>\n",
             width, height, text_height) +
         faces_svg(problem, view, sheet) + arrows_svg(problem, view, sheet) + "</svg>\n";
}

}  // namespace voussoir::problems
