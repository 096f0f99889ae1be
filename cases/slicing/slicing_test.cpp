// Rock slicing: a slope that construction joints shape, one joint pattern cut in four ways, and an assembly in space;
// conservation, and the number of blocks.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <limits>
#include <map>

#include "cases/case_tools.hpp"
#include "core/model/model.hpp"
#include "core/scene/draw_joint_sets.hpp"
#include "core/scene/scene.hpp"
#include "core/slicing/clump.hpp"
#include "reference/slicing/arrangement.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::slicing_test {
namespace {

using reference::Line2;
using verification::Bound;
using verification::CaseReport;
using verification::Kind;

// volumes are sums of up to 1e5 terms, each within some ulp of the whole
constexpr double conserved = 1e-12;
constexpr const char* why_conserved = "rounding of as many volumes as there are blocks";

template <int Dim>
Model<Dim> blocks_of(const std::string& scene, const std::vector<std::string>& overrides = {}) {
  const LoadedScene loaded = load_scene(std::filesystem::path(VOUSSOIR_CASE_DIR) / scene, overrides);
  return std::get<Prepared<Dim>>(loaded.prepared).model;
}

template <int Dim, class Select>
double volume_of(const Model<Dim>& model, const Select& select) {
  double sum = 0;
  for (const Body<Dim>& body : model.bodies)
    if (select(body)) sum += volume(body);
  return sum;
}

// ---- drawing: outlines of parts, separated by an empty line for gnuplot

template <class Select>
void draw_parts(const std::string& file, const Model<2>& model, const Select& select) {
  std::ofstream out(verification::case_output("slicing") / file);
  out.precision(9);
  out << "x_m,y_m\n";
  for (const Body<2>& body : model.bodies) {
    if (!select(body)) continue;
    for (const Polytope<2>& part : body.parts) {
      for (const int vertex : closed_ring(part)) {
        const Vector<2> p = model.origin + body.reference + part.vertices[vertex];
        out << p[0] << ',' << p[1] << '\n';
      }
      out << '\n';
    }
  }
}

// an edge of a part without the pieces that it shares with other parts of its body: pieces along it, from 0 to 1
std::vector<std::array<double, 2>> outer_pieces(const Body<2>& body, std::size_t part, std::size_t edge) {
  const Polytope<2>& own = body.parts[part];
  const Vector<2> from = own.vertices[own.loops[edge][0]], along = own.vertices[own.loops[edge][1]] - from;
  std::vector<std::array<double, 2>> pieces{{0, 1}};
  for (std::size_t p = 0; p < body.parts.size(); ++p) {
    const Polytope<2>& other = body.parts[p];
    for (std::size_t f = 0; f < other.faces.size(); ++f) {
      if (p == part || other.joints[f] == no_joint || other.joints[f] != own.joints[edge]) continue;
      double a = along.dot(other.vertices[other.loops[f][0]] - from) / along.squaredNorm();
      double b = along.dot(other.vertices[other.loops[f][1]] - from) / along.squaredNorm();
      if (a > b) std::swap(a, b);
      std::vector<std::array<double, 2>> left;
      for (const auto& [begin, end] : pieces) {
        if (begin < a) left.push_back({begin, std::min(end, a)});
        if (end > b) left.push_back({std::max(begin, b), end});
      }
      pieces = left;
    }
  }
  return pieces;
}

void draw_edges(const std::string& file, const Model<2>& model) {
  constexpr double visible = 1e-6;  // of an edge: shorter pieces are rounding
  std::vector<std::vector<double>> columns(4);
  for (const Body<2>& body : model.bodies)
    for (std::size_t p = 0; p < body.parts.size(); ++p)
      for (std::size_t f = 0; f < body.parts[p].faces.size(); ++f) {
        const Polytope<2>& part = body.parts[p];
        const Vector<2> from = part.vertices[part.loops[f][0]], along = part.vertices[part.loops[f][1]] - from;
        for (const auto& [begin, end] : outer_pieces(body, p, f)) {
          if (end - begin < visible) continue;
          const Vector<2> start = model.origin + body.reference + from + begin * along;
          for (int k = 0; k < 2; ++k) {
            columns[k].push_back(start[k]);
            columns[2 + k].push_back((end - begin) * along[k]);
          }
        }
      }
  write_csv("slicing", file, {"x_m", "y_m", "length_x_m", "length_y_m"}, columns);
}

// inscribed radius of its largest part, m
double largest_radius(const Body<2>& body) {
  double radius = 0;
  for (const Polytope<2>& part : body.parts)
    radius = std::max(radius, part.inscribed_radius);
  return radius;
}

// the joints of a scene in the plane from end to end, as far as its domain extends
void draw_traces(const std::string& file, const std::string& scene_file) {
  const Scene scene = with_drawn_joints<2>(read_scene(std::filesystem::path(VOUSSOIR_CASE_DIR) / scene_file));
  std::vector<std::vector<double>> columns(4);
  for (const JointSpec& joint : scene.joints) {
    const bool finite = joint.outline.shape != OutlineForm::none;
    const Vector<2> normal(joint.plane.normal[0], joint.plane.normal[1]), along = plane_axes(normal);
    const double half = finite ? joint.outline.length / 2 : 100;
    for (int k = 0; k < 2; ++k) {
      columns[k].push_back(joint.plane.point[k] - half * along[k]);
      columns[2 + k].push_back(2 * half * along[k]);
    }
  }
  write_csv("slicing", file, {"x_m", "y_m", "length_x_m", "length_y_m"}, columns);
}

// ---- the slope of Fig. 4.1

Line2 through(double x, double y, double dip_deg) {
  return {{std::sin(dip_deg * degree), std::cos(dip_deg * degree)},
          std::sin(dip_deg * degree) * x + std::cos(dip_deg * degree) * y};
}

// the area of slope.toml between its slide surface and its outline, by hand
double area_of_slide() {
  return reference::enclosed_area({through(718.38, 644, 37.4881), through(818.38, 620, 13.4957), through(0, 620, 0),
                                   through(920, 850, 37.9997), through(0, 850, 0), through(352, 1065, 32.8481),
                                   through(352, 1065, 19.0012)});
}

struct Slope {
  Model<2> model;
  int fixed = 0, clumped = 0, parts = 0;
  double free_area = 0;
};

Slope slope(const std::string& scene) {
  Slope found;
  found.model = blocks_of<2>(scene);
  for (const Body<2>& body : found.model.bodies) {
    found.fixed += body.fixed;
    found.clumped += body.parts.size() > 1;
    found.parts += static_cast<int>(body.parts.size());
  }
  found.free_area = volume_of(found.model, [](const Body<2>& body) { return !body.fixed; });
  return found;
}

Slope draw_slope(const std::string& name) {
  const Slope found = slope(name + ".toml");
  const auto clump = [](const Body<2>& body) { return !body.fixed && body.parts.size() > 1; };
  draw_parts(name + "_fixed.csv", found.model, [](const Body<2>& body) { return body.fixed; });
  draw_parts(name + "_single.csv", found.model, [&](const Body<2>& body) { return !body.fixed && !clump(body); });
  draw_parts(name + "_clumps.csv", found.model, clump);
  return found;
}

TEST(Slicing, ASlopeIsShapedByConstructionJointsAndExcavation) {
  CaseReport report("slicing", {"slope: area between slide surface and outline"});
  const Slope persistent = draw_slope("slope"), finite = draw_slope("slope_finite"),
              confined = slope("slope_confined.toml");
  const auto area_of = [&](const std::string& quantity, const Slope& found) {
    report.record(
        {.quantity = quantity,
         .unit = "m²",
         .source = "geometry: corners of seven lines, shoelace formula",
         .expected = area_of_slide(),
         .tolerance = {.relative = 1e-11},
         .because = "coordinates of 1000 m round at 1e-16 of their size, corners of acute angles at 1e-14 and "
                    "there are 100 blocks"},
        found.free_area);
  };
  area_of("slope: area between slide surface and outline", persistent);
  area_of("slope: area with finite cross joints", finite);
  const auto count = [&](const std::string& quantity, const std::string& source, double expected, double found) {
    report.record({.quantity = quantity,
                   .unit = "1",
                   .source = source,
                   .expected = expected,
                   .tolerance = {.absolute = 0.5},
                   .because = "a count"},
                  found);
  };
  count("slope: boundary blocks", "geometry: the rock below each of three boundary joints is one block", 3,
        persistent.fixed);
  count("slope: blocks cut along the outline alone",
        "geometry: construction joints through the whole domain, their sides one body",
        static_cast<double>(persistent.model.bodies.size()), static_cast<double>(confined.model.bodies.size()));
  const auto blocks = [](const Slope& found) { return static_cast<double>(found.model.bodies.size()); };
  report.report("slope: blocks", "1", blocks(persistent), "persistent joint sets");
  report.report("slope: blocks with finite cross joints", "1", blocks(finite), "each ends at the beds that it meets");
  report.report("slope: clumps", "1", persistent.clumped, "blocks of several parts, across construction joints");
  report.report("slope: clumps, cut along the outline alone", "1", confined.clumped, "the same blocks of fewer parts");
  report.report("slope: parts", "1", persistent.parts, "geometry: construction joints through everything");
  report.report("slope: parts, cut along the outline alone", "1", confined.parts, "construction joints end");
}

// ---- the pattern of Fig. 4.3

struct Treatment {
  std::string name, label;
  std::vector<std::string> overrides;
};

const std::vector<Treatment> treatments{
    {"persistent", "joints without end", {"slicing.ends=ignored"}},
    {"extended", "extended to the next joint", {}},
    {"sized", "extended, inscribed diameter at least 0.4 m", {"slicing.smallest_inscribed_radius=0.2"}},
    {"healed", "healed where a joint ends", {"slicing.ends=healed"}}};

constexpr double least_radius = 0.2;  // m

// the joints of pattern.toml as lines without end
std::vector<Line2> lines_of(const Scene& scene) {
  std::vector<Line2> lines;
  for (const JointSpec& joint : with_drawn_joints<2>(scene).joints) {
    const std::vector<double>&n = joint.plane.normal, &p = joint.plane.point;
    lines.push_back({{n[0], n[1]}, n[0] * p[0] + n[1] * p[1]});
  }
  return lines;
}

TEST(Slicing, OnePatternCutInFourWays) {
  CaseReport report("slicing", {"pattern: blocks of joints without end", "pattern: smallest block, sized"});
  std::map<std::string, Model<2>> models;
  for (const Treatment& t : treatments) {
    Model<2> model = blocks_of<2>("pattern.toml", t.overrides);
    report.record({.quantity = "pattern: area, " + t.name,
                   .unit = "m²",
                   .source = "geometry: the square of 10 m",
                   .expected = 100,
                   .tolerance = {.relative = conserved},
                   .because = why_conserved},
                  volume_of(model, [](const Body<2>&) { return true; }));
    double smallest = std::numeric_limits<double>::max();
    for (const Body<2>& body : model.bodies)
      smallest = std::min(smallest, body.size);
    const std::string quantity = "pattern: smallest block, " + t.name;
    if (t.name == "sized")
      report.record({.quantity = quantity,
                     .unit = "m",
                     .kind = Kind::limit,
                     .source = "demanded: pattern.toml with slicing.smallest_inscribed_radius",
                     .expected = least_radius,
                     .tolerance = {.relative = 1e-12, .bound = Bound::at_least},
                     .because = "rounding of the inscribed radius"},
                    smallest);
    else
      report.report(quantity, "m", smallest, "inscribed radius");
    report.report("pattern: blocks, " + t.name, "1", static_cast<double>(model.bodies.size()), t.label);
    // small blocks separately
    draw_parts("pattern_" + t.name + ".csv", model,
               [](const Body<2>& body) { return largest_radius(body) >= least_radius; });
    draw_parts("pattern_" + t.name + "_small.csv", model,
               [](const Body<2>& body) { return largest_radius(body) < least_radius; });
    draw_edges("pattern_" + t.name + "_edges.csv", model);
    models.emplace(t.name, std::move(model));
  }

  const Scene scene = read_scene(std::filesystem::path(VOUSSOIR_CASE_DIR) / "pattern.toml");
  const auto count = [&](const std::string& name) { return static_cast<double>(models.at(name).bodies.size()); };
  report.record({.quantity = "pattern: blocks of joints without end",
                 .unit = "1",
                 .source = "Buck (1943): 1 + lines + crossings within the square",
                 .expected = static_cast<double>(reference::pieces(lines_of(scene), {{0, 0}, {10, 10}})),
                 .tolerance = {.absolute = 0.5},
                 .because = "a count"},
                count("persistent"));
  const auto fewer = [&](const std::string& less, const std::string& more) {
    report.record({.quantity = "pattern: " + less + " has no more blocks than " + more,
                   .unit = "1",
                   .kind = Kind::limit,
                   .source = "geometry: every face of the former is one of the latter",
                   .expected = count(more),
                   .tolerance = {.absolute = 0.5, .bound = Bound::at_most},
                   .because = "a count"},
                  count(less));
  };
  fewer("healed", "extended");
  fewer("extended", "persistent");
  draw_traces("pattern_joints.csv", "pattern.toml");
  std::ofstream counts(verification::case_output("slicing") / "pattern_counts.csv");
  counts << "persistent,extended,sized,healed\n"
         << count("persistent") << ',' << count("extended") << ',' << count("sized") << ',' << count("healed") << '\n';
}

}  // namespace
}  // namespace voussoir::cases::slicing_test
