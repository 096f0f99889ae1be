#include "core/geometry/surface.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "core/geometry/half_space_inl.hpp"

namespace voussoir {
namespace {

// a vertex this close to a plane lies on it: the rounding of a few operations on coordinates of the box's size
constexpr double on_plane = 4 * std::numeric_limits<double>::epsilon();

// Many planes through nearly one point may leave faces that do not fit together; merging points within twice the
// distance repairs that. If it takes more doublings than this, the solid is thinner than its coordinates resolve.
constexpr int widenings = 8;

// from one box to the next larger one, as long as the solid reaches the box
constexpr double larger = 8;

// a solid that extends farther than this times the distance of its farthest plane counts as open
constexpr double largest_extent = 1e9;

// planes whose normals span less determine their common point no better than the cuts that made it
constexpr double well_conditioned = 1e-4;

// Corners nearer to each other than this times the band are one: more planes than dimensions through a point leave, cut
// in an unlucky order, several points in place of one.
constexpr double one_corner = 4;

// of a corner, by the sign of its distance to the plane that cuts, and not by Eq. B.1 over all planes
enum class CornerSide { unseen, in, on, out };

// a face: its corners are `size` entries of the solid's from `begin` on; negative planes are the box's
struct CutFacet {
  int plane;
  std::size_t begin, size;
};

// the solid between the planes that have cut so far
template <int Dim>
struct Solid {
  std::vector<Vector<Dim>> points;
  std::vector<CutFacet> facets;
  std::vector<int> corners;  // of one face after the other
  double band = 0;           // m: a point closer to a plane than this is on it

  void add(int plane, std::initializer_list<int> loop) {
    facets.push_back({plane, corners.size(), loop.size()});
    corners.insert(corners.end(), loop);
  }
  std::span<const int> loop(const CutFacet& f) const { return {corners.data() + f.begin, f.size}; }
};

// the point where a plane cuts the edge from corner i to corner j > i
struct Crossing {
  int i, j, point;
};

using Edge = std::pair<int, int>;

// memory of one cut after the other
struct Scratch {
  std::vector<double> distance;  // of each point from the plane, m
  std::vector<CornerSide> side;
  std::vector<Crossing> crossings;
  std::vector<char> in_plane;    // for each corner of the face in hand whether it lies in the cutting plane
  std::vector<CutFacet> facets;  // that remain
  std::vector<int> corners;
  std::vector<Edge> rim, links;  // of the new face
  std::vector<int> ends;         // in the plane: how often a point ends a face, less how often it begins one
};

Solid<2> box(double half, std::integral_constant<int, 2>) {
  Solid<2> solid{{{-half, -half}, {half, -half}, {half, half}, {-half, half}}, {}, {}};
  for (int k = 0; k < 4; ++k)
    solid.add(-1 - k, {k, (k + 1) % 4});
  return solid;
}

// corner i has coordinate k on the high side when bit k of i is set
Solid<3> box(double half, std::integral_constant<int, 3>) {
  Solid<3> solid;
  for (int i = 0; i < 8; ++i)
    solid.points.emplace_back(i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half);
  solid.add(-1, {0, 4, 6, 2});
  solid.add(-2, {1, 3, 7, 5});
  solid.add(-3, {0, 1, 5, 4});
  solid.add(-4, {2, 6, 7, 3});
  solid.add(-5, {0, 2, 3, 1});
  solid.add(-6, {4, 5, 7, 6});
  return solid;
}

// the point where the plane cuts an edge, made once
template <int Dim>
int crossing_between(int from, int to, Solid<Dim>& solid, Scratch& scratch) {
  const auto [i, j] = std::minmax(from, to);
  for (const Crossing& known : scratch.crossings)
    if (known.i == i && known.j == j) return known.point;
  const double fraction = scratch.distance[i] / (scratch.distance[i] - scratch.distance[j]);
  const int point = static_cast<int>(solid.points.size());
  solid.points.push_back(solid.points[i] + fraction * (solid.points[j] - solid.points[i]));
  scratch.crossings.push_back({i, j, point});
  return point;
}

// the rest of a face, behind the faces that remain so far
template <int Dim>
void cut_face(const CutFacet& face, Solid<Dim>& solid, Scratch& scratch) {
  const std::vector<CornerSide>& side = scratch.side;
  const std::size_t begin = scratch.corners.size();
  scratch.in_plane.clear();
  const auto keep = [&](int vertex, bool in_plane) {
    scratch.corners.push_back(vertex);
    scratch.in_plane.push_back(in_plane);
  };
  const std::size_t steps = Dim == 2 ? 1 : face.size;  // in the plane a face is one edge, not a ring
  for (std::size_t k = 0; k < steps; ++k) {
    const int here = solid.corners[face.begin + k], next = solid.corners[face.begin + (k + 1) % face.size];
    if (side[here] != CornerSide::out) keep(here, side[here] == CornerSide::on);
    if ((side[here] == CornerSide::in && side[next] == CornerSide::out) ||
        (side[here] == CornerSide::out && side[next] == CornerSide::in))
      keep(crossing_between(here, next, solid, scratch), true);
    if (Dim == 2 && side[next] != CornerSide::out) keep(next, side[next] == CornerSide::on);
  }
  scratch.facets.push_back({face.plane, begin, scratch.corners.size() - begin});
}

// The new face's loop, behind the faces that remain, from its edges, each seen from the face beyond it; of no size when
// they form no single ring.
std::size_t add_ring(Scratch& scratch) {
  std::vector<Edge>& links = scratch.links;
  links.clear();
  for (const Edge& edge : scratch.rim)
    if (std::find(scratch.rim.begin(), scratch.rim.end(), Edge(edge.second, edge.first)) == scratch.rim.end())
      links.push_back(edge);
  if (links.empty()) return 0;
  std::sort(links.begin(), links.end());
  const auto same_start = [](const Edge& a, const Edge& b) { return a.first == b.first; };
  if (std::adjacent_find(links.begin(), links.end(), same_start) != links.end()) return 0;
  const int first = links.front().first;
  std::size_t size = 0;
  for (int at = first; size < links.size();) {
    scratch.corners.push_back(at);
    ++size;
    const auto step = std::lower_bound(links.begin(), links.end(), Edge(at, std::numeric_limits<int>::min()));
    if (step == links.end() || step->first != at) return 0;
    at = step->second;
    if (at == first) break;
  }
  return size == links.size() ? size : 0;
}

// in the plane the new face runs from where the ring of faces now ends to where it begins
std::size_t add_gap(std::size_t points, Scratch& scratch) {
  scratch.ends.assign(points, 0);
  for (const CutFacet& f : scratch.facets) {
    --scratch.ends[scratch.corners[f.begin]];
    ++scratch.ends[scratch.corners[f.begin + 1]];
  }
  int loop[2] = {-1, -1};
  for (std::size_t v = 0; v < points; ++v)
    if (const int count = scratch.ends[v]; count != 0) loop[count > 0 ? 0 : 1] = static_cast<int>(v);
  if (loop[0] < 0 || loop[1] < 0) return 0;
  scratch.corners.insert(scratch.corners.end(), {loop[0], loop[1]});
  return 2;
}

// false when the remaining faces do not fit together
template <int Dim>
bool cut(Solid<Dim>& solid, const HalfSpace<Dim>& plane, int number, double negligible, Scratch& scratch) {
  scratch.distance.assign(solid.points.size(), 0);
  scratch.side.assign(solid.points.size(), CornerSide::unseen);
  double deepest = 0;
  for (const int v : solid.corners) {
    if (scratch.side[v] != CornerSide::unseen) continue;
    const double distance = scratch.distance[v] = signed_distance(plane, solid.points[v]);
    scratch.side[v] = std::abs(distance) <= solid.band ? CornerSide::on
                      : distance > 0                   ? CornerSide::out
                                                       : CornerSide::in;
    deepest = std::max(deepest, distance);
  }
  if (deepest <= std::max(negligible, solid.band)) return true;

  scratch.crossings.clear();
  scratch.facets.clear();
  scratch.corners.clear();
  scratch.rim.clear();
  for (const CutFacet& f : solid.facets) {
    const auto inside = [&](int v) { return scratch.side[v] == CornerSide::in; };
    const std::span<const int> whole = solid.loop(f);
    if (std::none_of(whole.begin(), whole.end(), inside)) continue;
    cut_face<Dim>(f, solid, scratch);
    const CutFacet& left = scratch.facets.back();
    for (std::size_t k = 0; Dim == 3 && k < left.size; ++k) {
      const std::size_t next = (k + 1) % left.size;
      if (scratch.in_plane[k] && scratch.in_plane[next])
        scratch.rim.emplace_back(scratch.corners[left.begin + next], scratch.corners[left.begin + k]);
    }
  }
  const std::size_t begin = scratch.corners.size();
  const std::size_t size = Dim == 3 ? add_ring(scratch) : add_gap(solid.points.size(), scratch);
  if (size < Dim) return false;
  scratch.facets.push_back({number, begin, size});
  std::swap(solid.facets, scratch.facets);
  std::swap(solid.corners, scratch.corners);
  return true;
}

// the common point of the planes, refined once
template <int Dim>
Vector<Dim> common_point(const Matrix<Dim>& normals, const Vector<Dim>& offsets) {
  const Matrix<Dim> inverse = normals.inverse();
  const Vector<Dim> point = inverse * offsets;
  return point + inverse * (offsets - normals * point);
}

// The vertex again from Dim of the planes through it, each chosen with the largest angle to those before: cutting left
// it with the rounding of the box.
template <int Dim>
void sharpen(Vector<Dim>& point, const HalfSpaces<Dim>& faces, std::span<const int> through) {
  Matrix<Dim> normals;
  Vector<Dim> offsets;
  double spanned = 1;  // length, area, then volume that the chosen normals span
  const auto choose = [&](int k, auto&& measure) {
    int best = through.front();
    spanned = -1;
    for (const int face : through)
      if (const double m = measure(faces[face].normal); m > spanned) {
        spanned = m;
        best = face;
      }
    normals.row(k) = faces[best].normal.transpose();
    offsets[k] = faces[best].offset;
  };
  choose(0, [](const Vector<Dim>&) { return 1.0; });
  const Vector<Dim> first = normals.row(0);
  if constexpr (Dim == 2) {
    choose(1, [&](const Vector<2>& n) { return std::abs(perpendicular(first).dot(n)); });
  } else {
    choose(1, [&](const Vector<3>& n) { return first.cross(n).norm(); });
    const Vector<3> along = first.cross(Vector<3>(normals.row(1)));
    choose(2, [&](const Vector<3>& n) { return std::abs(along.dot(n)); });
  }
  if (spanned > well_conditioned) point = common_point<Dim>(normals, offsets);
}

// Edges shorter than the resolution shrink to a point; faces that lose their area with them are removed. The remaining
// faces still fit together: an edge that shrinks does so in both of its faces.
template <int Dim>
void shrink_short_edges(Surface<Dim>& surface, double shortest) {
  std::vector<int> stands_for(surface.vertices.size());
  std::iota(stands_for.begin(), stands_for.end(), 0);
  const auto root = [&](int v) {
    while (stands_for[v] != v)
      v = stands_for[v];
    return v;
  };
  for (const std::vector<int>& loop : surface.loops)
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const int i = root(loop[k]), j = root(loop[(k + 1) % loop.size()]);
      if (i != j && (surface.vertices[i] - surface.vertices[j]).norm() <= shortest)
        stands_for[std::max(i, j)] = std::min(i, j);
    }

  // new numbers for those that stay
  std::vector<int> number(surface.vertices.size());
  std::vector<Vector<Dim>> vertices;
  for (std::size_t v = 0; v < number.size(); ++v) {
    number[v] = static_cast<int>(vertices.size());
    if (stands_for[v] == static_cast<int>(v)) vertices.push_back(surface.vertices[v]);
  }
  if (vertices.size() == surface.vertices.size()) return;
  surface.vertices = std::move(vertices);
  for (std::vector<int>& loop : surface.loops) {
    for (int& v : loop)
      v = number[root(v)];
    loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
    while (loop.size() > 1 && loop.front() == loop.back())
      loop.pop_back();
    if (static_cast<int>(loop.size()) < Dim) loop.clear();
  }
}

template <int Dim>
Surface<Dim> surface_of(const Solid<Dim>& solid, const HalfSpaces<Dim>& faces) {
  Surface<Dim> surface;
  surface.loops.resize(faces.size());
  std::vector<int> name(solid.points.size(), -1);
  std::vector<Edge> through;  // vertex and plane
  through.reserve(solid.corners.size());
  for (const CutFacet& f : solid.facets) {
    if (f.plane < 0) {
      surface.status = SurfaceStatus::open;
      return surface;
    }
    for (const int v : solid.loop(f)) {
      if (name[v] < 0) {
        name[v] = static_cast<int>(surface.vertices.size());
        surface.vertices.push_back(solid.points[v]);
      }
      through.emplace_back(name[v], f.plane);
      surface.loops[f.plane].push_back(name[v]);
    }
  }
  std::sort(through.begin(), through.end());
  std::vector<int> planes;
  for (std::size_t k = 0; k < through.size();) {
    const int vertex = through[k].first;
    planes.clear();
    for (; k < through.size() && through[k].first == vertex; ++k)
      planes.push_back(through[k].second);
    sharpen<Dim>(surface.vertices[vertex], faces, planes);
  }
  shrink_short_edges(surface, one_corner * solid.band);
  return surface;
}

template <int Dim>
bool cut_all(Solid<Dim>& solid, const HalfSpaces<Dim>& faces, double negligible) {
  Scratch scratch;
  for (int f = static_cast<int>(faces.size()) - 1; f >= 0; --f)
    if (!cut<Dim>(solid, faces[f], f, negligible, scratch)) return false;
  return true;
}

template <int Dim>
Surface<Dim> cut_from_box(const HalfSpaces<Dim>& faces, double half, double negligible) {
  double band = on_plane * half;
  for (int attempt = 0; attempt <= widenings; ++attempt, band *= 2) {
    Solid<Dim> solid = box(half, std::integral_constant<int, Dim>{});
    solid.band = band;
    if (cut_all<Dim>(solid, faces, negligible)) return surface_of<Dim>(solid, faces);
  }
  return {SurfaceStatus::unresolved, {}, {}};
}

}  // namespace

template <int Dim>
Surface<Dim> find_surface(const HalfSpaces<Dim>& faces, double negligible) {
  double nearest = 0;
  for (const HalfSpace<Dim>& f : faces)
    nearest = std::max(nearest, std::abs(f.offset));
  // a box that encloses everything, then one that fits
  double half = 2 * nearest;
  Surface<Dim> surface = cut_from_box<Dim>(faces, half, negligible);
  while (surface.status == SurfaceStatus::open && half < largest_extent * nearest) {
    half *= larger;
    surface = cut_from_box<Dim>(faces, half, negligible);
  }
  double extent = 0;
  for (const Vector<Dim>& v : surface.vertices)
    extent = std::max(extent, v.cwiseAbs().maxCoeff());
  // its coordinates have the rounding of the first box
  if (surface.status == SurfaceStatus::ok && half > 2 * extent)
    surface = cut_from_box<Dim>(faces, 2 * extent, negligible);
  return surface;
}

template Surface<2> find_surface<2>(const HalfSpaces<2>&, double);
template Surface<3> find_surface<3>(const HalfSpaces<3>&, double);

}  // namespace voussoir
