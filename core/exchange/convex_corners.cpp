#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numbers>

#include "core/exchange/mesh.hpp"
#include "text/text_scan.hpp"

namespace voussoir {
namespace {

// How far a corner may lie outside a facet's plane, over the mesh's extent: ten times the resolution of single
// precision for the coordinates of a block near the origin. A slender facet turns with that rounding by its extent over
// its height.
constexpr double out_of_plane = 1e-6;

// In spacings of the file's numbers, how far rounding may move a corner outside a facet: both it and the facet's first
// corner have errors of half the spacing along each axis, √3/2 of it in space, and the facet is turned by at most twice
// √3 spacing over its height, over which the corner may lie as far as the mesh extends.
constexpr double rounded_out = 3 * std::numbers::sqrt3;
// of the mesh's extent: a coarser spacing changes the shape, and excuses no lack of convexity
constexpr double largest_spacing = 2e-3;
// a facet that rounding may turn by more (rad) determines no plane
constexpr double loose_facet = 0.1;
// of the shortest edge: numbers farther apart deserve a warning, in a text from so many digits on, as single
// precision has them; people state fewer, and mean them exactly
constexpr double noticed_spacing = 1e-3;
constexpr int digits_of_floats = 6;

std::string text(const Vector<3>& p) {
  return fmt::format("({:.9g}, {:.9g}, {:.9g})", p[0], p[1], p[2]);
}

std::string place(const Mesh& mesh, std::size_t facet) {
  const int line = mesh.facets[facet].line;
  return line > 0 ? fmt::format("the facet of line {}", line) : fmt::format("facet {}", facet + 1);
}

// twice the area, along the normal (Newell's sum about the first corner)
Vector<3> area_vector(const Mesh& mesh, const Facet& facet) {
  Vector<3> sum = Vector<3>::Zero();
  const Vector<3>& first = mesh.points[facet.corners[0]];
  for (std::size_t k = 1; k + 1 < facet.corners.size(); ++k)
    sum += (mesh.points[facet.corners[k]] - first).cross(mesh.points[facet.corners[k + 1]] - first);
  return sum;
}

// Closed: every edge is run along once in each direction.
void check_closed(const Mesh& mesh) {
  std::map<std::pair<int, int>, std::size_t> runs;  // from, to: the facet
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const std::vector<int>& corners = mesh.facets[f].corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto [at, added] = runs.emplace(std::pair(corners[k], corners[(k + 1) % corners.size()]), f);
      if (!added)
        throw FileFault(mesh.facets[f].line, 0,
                        fmt::format("runs along the edge from {} to {} as {} does: one of them is turned over, occurs "
                                    "twice, or three facets meet there",
                                    text(mesh.points[at->first.first]), text(mesh.points[at->first.second]),
                                    place(mesh, at->second)));
    }
  }
  for (const auto& [edge, facet] : runs)
    if (!runs.contains({edge.second, edge.first}))
      throw FileFault(mesh.facets[facet].line, 0,
                      fmt::format("the surface is open: at the edge from {} to {} {} has no neighbour; add the missing "
                                  "facet, or write equal corners of neighbours with equal numbers",
                                  text(mesh.points[edge.first]), text(mesh.points[edge.second]), place(mesh, facet)));
}

// one piece: facets that share an edge are joined
void check_one_piece(const Mesh& mesh) {
  std::vector<int> root(mesh.points.size());
  for (std::size_t i = 0; i < root.size(); ++i)
    root[i] = static_cast<int>(i);
  const auto find = [&](int i) {
    while (root[i] != i)
      i = root[i] = root[root[i]];
    return i;
  };
  for (const Facet& facet : mesh.facets)
    for (const int corner : facet.corners)
      root[find(corner)] = find(facet.corners[0]);
  for (const Facet& facet : mesh.facets)
    if (find(facet.corners[0]) != find(mesh.facets[0].corners[0]))
      throw FileFault(facet.line, 0,
                      "belongs to another piece than the first facet; give every block a solid or object of its own");
}

double volume_times_six(const Mesh& mesh) {
  double sum = 0;
  for (const Facet& facet : mesh.facets)
    sum += area_vector(mesh, facet).dot(mesh.points[facet.corners[0]] - mesh.points[0]);
  return sum;
}

// A facet's plane, outward for either orientation of the mesh, and how far outside it a corner may lie.
struct FacetSide {
  Vector<3> normal = Vector<3>::Zero();  // zero: a sliver, which is ignored; its neighbours bound the solid
  double tolerance = 0;                  // m
  double rounding = 0;                   // m, by the digits of the file alone
  double turned = 0;                     // rad, by rounding at most
};

FacetSide side_of(const Mesh& mesh, const Facet& facet, double extent, bool inside_out) {
  double longest = 0;
  for (std::size_t k = 0; k < facet.corners.size(); ++k)
    longest = std::max(longest, (mesh.points[facet.corners[k]] - mesh.points[facet.corners[0]]).norm());
  const Vector<3> area = area_vector(mesh, facet);
  const double length = area.norm();
  if (!(length > out_of_plane * extent * longest)) return {};
  const double height = length / longest, spacing = std::min(mesh.spacing, largest_spacing * extent);
  const double turned = 2 * std::numbers::sqrt3 * spacing / height;
  if (turned > loose_facet) return {};
  const double slender = std::max(1.0, extent / height);
  return {inside_out ? Vector<3>(-area / length) : Vector<3>(area / length),
          std::max(out_of_plane * extent, rounded_out * spacing) * slender, rounded_out * mesh.spacing * slender,
          turned};
}

std::vector<FacetSide> sides_of(const Mesh& mesh, double extent) {
  const double six_volumes = volume_times_six(mesh);
  if (!(std::abs(six_volumes) > out_of_plane * extent * extent * extent * out_of_plane))
    throw FileFault(mesh.line, 0, "the surface bounds no volume; is it a sheet?");
  std::vector<FacetSide> sides;
  for (const Facet& facet : mesh.facets)
    sides.push_back(side_of(mesh, facet, extent, six_volumes < 0));
  return sides;
}

std::string stated_to(const Mesh& mesh) {
  return mesh.digits > 0 ? fmt::format("its coordinates are stated to {:.3g} m", mesh.spacing)
                         : fmt::format("its numbers of single precision are {:.3g} m apart", mesh.spacing);
}

// the largest distance of a corner outside a facet, or off the plane of its own, that passes as rounding, m
double check_convex(const Mesh& mesh, const std::vector<FacetSide>& sides, double extent) {
  double farthest = 0;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    for (const Facet& other : mesh.facets)
      for (const int corner : other.corners) {
        const double outside = sides[f].normal.dot(mesh.points[corner] - mesh.points[mesh.facets[f].corners[0]]);
        if (outside > sides[f].tolerance)
          throw FileFault(
              other.line, 0,
              fmt::format("the block is not convex: its corner {} is {:.3g} m outside {}; {}split it into convex "
                          "blocks, with part_of for one body",
                          text(mesh.points[corner]), outside, place(mesh, f),
                          outside > sides[f].rounding
                              ? ""
                              : stated_to(mesh) + ", which may be why: write them with more digits, or "));
        const double beside = &other == &mesh.facets[f] ? std::abs(outside) : outside;
        if (beside > out_of_plane * extent) farthest = std::max(farthest, beside);
      }
  return farthest;
}

// the facets at a corner span space; on an edge they span a plane, within a face a line
bool is_corner(const std::vector<const FacetSide*>& around) {
  double parallel = 1e-5;  // sine of the least angle between two distinct faces
  for (const FacetSide* side : around)
    parallel = std::max(parallel, 2 * side->turned);
  for (const FacetSide* a : around)
    for (const FacetSide* b : around) {
      const Vector<3> edge = a->normal.cross(b->normal);
      if (edge.norm() <= parallel) continue;
      return std::any_of(around.begin(), around.end(),
                         [&](const FacetSide* c) { return std::abs(edge.normalized().dot(c->normal)) > parallel; });
    }
  return false;
}

// the effect of the rounding of its coordinates on the block
void remark_rounding(const Mesh& mesh, double farthest, std::vector<FileRemark>& remarks) {
  const std::string name = mesh.name.empty() ? "the block" : "block " + shown(mesh.name);
  if (farthest > 0)
    remarks.push_back(
        {mesh.line,
         fmt::format("{}: corners deviate by up to {:.3g} m from the planes of its facets, within the rounding of "
                     "a file in which {}: its convex hull was taken",
                     name, farthest, stated_to(mesh))});
  double shortest = std::numeric_limits<double>::infinity();
  for (const Facet& facet : mesh.facets)
    for (std::size_t k = 0; k < facet.corners.size(); ++k)
      shortest =
          std::min(shortest,
                   (mesh.points[facet.corners[(k + 1) % facet.corners.size()]] - mesh.points[facet.corners[k]]).norm());
  if (mesh.spacing > noticed_spacing * shortest && (mesh.digits == 0 || mesh.digits >= digits_of_floats))
    remarks.push_back(
        {mesh.line,
         fmt::format("{}: {}, its shortest edge is {:.3g} m: its shape and volume are off by as much; move it near the "
                     "origin before it is written, or write OBJ with more digits",
                     name, stated_to(mesh), shortest)});
}

}  // namespace

std::vector<Vector<3>> convex_corners(const Mesh& mesh, std::vector<FileRemark>* remarks) {
  constexpr std::size_t fewest_facets = 4;
  if (mesh.facets.size() < fewest_facets)
    throw FileFault(mesh.line, 0, fmt::format("has {} facets; a solid has at least 4", mesh.facets.size()));
  check_closed(mesh);
  check_one_piece(mesh);
  double extent = 0;
  for (const Facet& facet : mesh.facets)
    extent = std::max(extent, (mesh.points[facet.corners[0]] - mesh.points[mesh.facets[0].corners[0]]).norm());
  const std::vector<FacetSide> sides = sides_of(mesh, extent);
  const double farthest = check_convex(mesh, sides, extent);
  if (remarks) remark_rounding(mesh, farthest, *remarks);

  std::vector<std::vector<const FacetSide*>> around(mesh.points.size());
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    for (const int corner : mesh.facets[f].corners)
      if (!sides[f].normal.isZero()) around[corner].push_back(&sides[f]);
  std::vector<Vector<3>> corners;
  for (std::size_t i = 0; i < around.size(); ++i)
    if (is_corner(around[i])) corners.push_back(mesh.points[i]);
  return corners;
}

}  // namespace voussoir
