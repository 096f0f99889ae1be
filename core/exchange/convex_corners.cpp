#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/exchange/mesh.hpp"

namespace voussoir {
namespace {

// How far a corner may lie outside a facet's plane, over the mesh's extent: ten times what single precision leaves of
// the coordinates of a block near the origin. A slender facet turns with that rounding by its extent over its height.
constexpr double out_of_plane = 1e-6;

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
                        fmt::format("runs along the edge from {} to {} as {} does: one of them is turned over, stands "
                                    "twice, or three facets meet there",
                                    text(mesh.points[at->first.first]), text(mesh.points[at->first.second]),
                                    place(mesh, at->second)));
    }
  }
  for (const auto& [edge, facet] : runs)
    if (!runs.contains({edge.second, edge.first}))
      throw FileFault(mesh.facets[facet].line, 0,
                      fmt::format("the surface is open: at the edge from {} to {} {} has no neighbour; add the missing "
                                  "facet, or write the corners of neighbours alike",
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

// A facet's plane, outward whichever way round the whole mesh is, and how far outside it a corner may lie.
struct Side {
  Vector<3> normal = Vector<3>::Zero();  // zero: a sliver, which says nothing; its neighbours bound the solid
  double tolerance = 0;                  // m
};

Side side_of(const Mesh& mesh, const Facet& facet, double extent, bool inside_out) {
  double longest = 0;
  for (std::size_t k = 0; k < facet.corners.size(); ++k)
    longest = std::max(longest, (mesh.points[facet.corners[k]] - mesh.points[facet.corners[0]]).norm());
  const Vector<3> area = area_vector(mesh, facet);
  const double length = area.norm(), height = length / longest;
  if (!(height > out_of_plane * extent)) return {};
  return {inside_out ? Vector<3>(-area / length) : Vector<3>(area / length),
          out_of_plane * extent * std::max(1.0, extent / height)};
}

std::vector<Side> sides_of(const Mesh& mesh, double extent) {
  const double six_volumes = volume_times_six(mesh);
  if (!(std::abs(six_volumes) > out_of_plane * extent * extent * extent * out_of_plane))
    throw FileFault(mesh.line, 0, "the surface bounds no volume; is it a sheet?");
  std::vector<Side> sides;
  for (const Facet& facet : mesh.facets)
    sides.push_back(side_of(mesh, facet, extent, six_volumes < 0));
  return sides;
}

void check_convex(const Mesh& mesh, const std::vector<Side>& sides) {
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    for (const Facet& other : mesh.facets)
      for (const int corner : other.corners) {
        const double outside = sides[f].normal.dot(mesh.points[corner] - mesh.points[mesh.facets[f].corners[0]]);
        if (outside > sides[f].tolerance)
          throw FileFault(other.line, 0,
                          fmt::format("the block is not convex: its corner {} lies {:.3g} m outside {}; split it into "
                                      "convex blocks, with part_of for one body",
                                      text(mesh.points[corner]), outside, place(mesh, f)));
      }
}

// the facets at a corner span space; on an edge they span a plane, within a face a line
bool is_corner(const std::vector<Vector<3>>& around) {
  constexpr double parallel = 1e-5;  // sine of the least angle between faces that are two
  for (const Vector<3>& a : around)
    for (const Vector<3>& b : around) {
      const Vector<3> edge = a.cross(b);
      if (edge.norm() <= parallel) continue;
      return std::any_of(around.begin(), around.end(),
                         [&](const Vector<3>& c) { return std::abs(edge.normalized().dot(c)) > parallel; });
    }
  return false;
}

}  // namespace

std::vector<Vector<3>> convex_corners(const Mesh& mesh) {
  constexpr std::size_t fewest_facets = 4;
  if (mesh.facets.size() < fewest_facets)
    throw FileFault(mesh.line, 0, fmt::format("has {} facets; a solid has at least 4", mesh.facets.size()));
  check_closed(mesh);
  check_one_piece(mesh);
  double extent = 0;
  for (const Facet& facet : mesh.facets)
    extent = std::max(extent, (mesh.points[facet.corners[0]] - mesh.points[mesh.facets[0].corners[0]]).norm());
  const std::vector<Side> sides = sides_of(mesh, extent);
  check_convex(mesh, sides);

  std::vector<std::vector<Vector<3>>> around(mesh.points.size());
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    for (const int corner : mesh.facets[f].corners)
      if (!sides[f].normal.isZero()) around[corner].push_back(sides[f].normal);
  std::vector<Vector<3>> corners;
  for (std::size_t i = 0; i < around.size(); ++i)
    if (is_corner(around[i])) corners.push_back(mesh.points[i]);
  return corners;
}

}  // namespace voussoir
