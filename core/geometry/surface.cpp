#include "core/geometry/surface.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace voussoir {
namespace {

// a vertex this close to a plane lies on it: the rounding of a few operations on coordinates of the box's size
constexpr double on_plane = 4 * std::numeric_limits<double>::epsilon();

// Many planes through nearly one point may leave faces that do not fit together; taking points within twice the
// distance for one mends that. More often than this, and the solid is thinner than its coordinates resolve.
constexpr int widenings = 8;

// from one box to the next larger one, as long as the solid reaches the box
constexpr double larger = 8;

// a solid that extends farther than this times the distance of its farthest plane is taken for open
constexpr double farthest = 1e9;

// planes whose normals span less are no better a place for their common point than the cuts that made it
constexpr double well_conditioned = 1e-4;

// Corners nearer to each other than this times the band are one: more planes than dimensions through a point leave, cut
// in an unlucky order, several points where one is meant.
constexpr double one_corner = 4;

enum class Side { in, on, out };

// what lies between the planes that have cut so far; negative planes are the box's
template <int Dim>
struct Facet {
  int plane;
  std::vector<int> loop;
};

template <int Dim>
struct Solid {
  std::vector<Vector<Dim>> points;
  std::vector<Facet<Dim>> facets;
  double band;  // m: closer to a plane than this is on it
};

Solid<2> box(double half, std::integral_constant<int, 2>) {
  return {{{-half, -half}, {half, -half}, {half, half}, {-half, half}},
          {{-1, {0, 1}}, {-2, {1, 2}}, {-3, {2, 3}}, {-4, {3, 0}}},
          0};
}

// corner i has coordinate k on the high side when bit k of i is set
Solid<3> box(double half, std::integral_constant<int, 3>) {
  Solid<3> solid{{},
                 {{-1, {0, 4, 6, 2}},
                  {-2, {1, 3, 7, 5}},
                  {-3, {0, 1, 5, 4}},
                  {-4, {2, 6, 7, 3}},
                  {-5, {0, 2, 3, 1}},
                  {-6, {4, 5, 7, 6}}},
                 0};
  for (int i = 0; i < 8; ++i)
    solid.points.emplace_back(i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half);
  return solid;
}

// the vertices where a plane cuts edges, each made once
template <int Dim>
struct Crossings {
  Solid<Dim>& solid;
  const std::vector<double>& distance;
  std::map<std::pair<int, int>, int> made;

  int between(int from, int to) {
    const std::pair<int, int> edge = std::minmax(from, to);
    const auto [place, is_new] = made.try_emplace(edge, static_cast<int>(solid.points.size()));
    if (is_new) {
      const auto [i, j] = edge;
      const double share = distance[i] / (distance[i] - distance[j]);
      solid.points.push_back(solid.points[i] + share * (solid.points[j] - solid.points[i]));
    }
    return place->second;
  }
};

// what is left of a loop, and for each of its corners whether it lies in the cutting plane
struct Remainder {
  std::vector<int> loop;
  std::vector<bool> in_plane;
};

template <int Dim>
Remainder cut_loop(const std::vector<int>& loop, const std::vector<Side>& side, Crossings<Dim>& crossings) {
  Remainder left;
  const std::size_t steps = Dim == 2 ? 1 : loop.size();  // in the plane a face is one edge, not a ring
  const auto keep = [&](int vertex, bool in_plane) {
    left.loop.push_back(vertex);
    left.in_plane.push_back(in_plane);
  };
  for (std::size_t k = 0; k < steps; ++k) {
    const int here = loop[k], next = loop[(k + 1) % loop.size()];
    if (side[here] != Side::out) keep(here, side[here] == Side::on);
    if ((side[here] == Side::in && side[next] == Side::out) || (side[here] == Side::out && side[next] == Side::in))
      keep(crossings.between(here, next), true);
    if (Dim == 2 && side[next] != Side::out) keep(next, side[next] == Side::on);
  }
  return left;
}

// The new face's loop from its edges, each seen from the face beyond it; empty when they form no single ring.
std::vector<int> ring(const std::vector<std::pair<int, int>>& edges) {
  std::map<int, int> next;
  for (const auto& [from, to] : edges)
    if (std::find(edges.begin(), edges.end(), std::pair(to, from)) == edges.end() && !next.try_emplace(from, to).second)
      return {};
  std::vector<int> loop;
  if (next.empty()) return loop;
  for (int at = next.begin()->first; loop.size() < next.size();) {
    loop.push_back(at);
    const auto step = next.find(at);
    if (step == next.end()) return {};
    at = step->second;
    if (at == loop.front()) break;
  }
  return loop.size() == next.size() ? loop : std::vector<int>{};
}

// in the plane the new face runs from where the ring of faces now ends to where it begins
std::vector<int> gap(const std::vector<Facet<2>>& facets) {
  std::map<int, int> open;  // how often a vertex ends a face, less how often it begins one
  for (const Facet<2>& f : facets) {
    --open[f.loop[0]];
    ++open[f.loop[1]];
  }
  std::vector<int> loop(2, -1);
  for (const auto& [vertex, count] : open)
    if (count != 0) loop[count > 0 ? 0 : 1] = vertex;
  return loop[0] < 0 || loop[1] < 0 ? std::vector<int>{} : loop;
}

// false when the faces left do not fit together
template <int Dim>
bool cut(Solid<Dim>& solid, const HalfSpace<Dim>& plane, int number, double negligible) {
  std::vector<double> distance(solid.points.size(), 0);
  std::vector<Side> side(solid.points.size(), Side::on);
  double deepest = 0;
  for (const Facet<Dim>& f : solid.facets)
    for (const int v : f.loop) {
      distance[v] = signed_distance(plane, solid.points[v]);
      if (std::abs(distance[v]) > solid.band) side[v] = distance[v] > 0 ? Side::out : Side::in;
      deepest = std::max(deepest, distance[v]);
    }
  if (deepest <= std::max(negligible, solid.band)) return true;

  Crossings<Dim> crossings{solid, distance, {}};
  std::vector<Facet<Dim>> left;
  std::vector<std::pair<int, int>> rim;
  for (const Facet<Dim>& f : solid.facets) {
    if (std::none_of(f.loop.begin(), f.loop.end(), [&](int v) { return side[v] == Side::in; })) continue;
    Remainder r = cut_loop<Dim>(f.loop, side, crossings);
    for (std::size_t k = 0; Dim == 3 && k < r.loop.size(); ++k) {
      const std::size_t next = (k + 1) % r.loop.size();
      if (r.in_plane[k] && r.in_plane[next]) rim.emplace_back(r.loop[next], r.loop[k]);
    }
    left.push_back({f.plane, std::move(r.loop)});
  }
  solid.facets = std::move(left);
  std::vector<int> face;
  if constexpr (Dim == 3)
    face = ring(rim);
  else
    face = gap(solid.facets);
  if (static_cast<int>(face.size()) < Dim) return false;
  solid.facets.push_back({number, std::move(face)});
  return true;
}

// the common point of the planes, refined once
template <int Dim>
Vector<Dim> common_point(const Matrix<Dim>& normals, const Vector<Dim>& offsets) {
  const Matrix<Dim> inverse = normals.inverse();
  const Vector<Dim> point = inverse * offsets;
  return point + inverse * (offsets - normals * point);
}

// The vertex anew from Dim of the planes through it, each chosen to lean most against those before: cutting left the
// rounding of the box.
template <int Dim>
void sharpen(Vector<Dim>& point, const HalfSpaces<Dim>& faces, const std::vector<int>& through) {
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

// Edges too short to mean anything shrink to a point; faces that lose their area with them go. What is left still fits
// together: an edge that shrinks does so in both of its faces.
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
  std::vector<std::vector<int>> through;
  for (const Facet<Dim>& f : solid.facets) {
    if (f.plane < 0) {
      surface.status = SurfaceStatus::open;
      return surface;
    }
    for (const int v : f.loop) {
      if (name[v] < 0) {
        name[v] = static_cast<int>(surface.vertices.size());
        surface.vertices.push_back(solid.points[v]);
        through.emplace_back();
      }
      through[name[v]].push_back(f.plane);
      surface.loops[f.plane].push_back(name[v]);
    }
  }
  for (std::size_t v = 0; v < through.size(); ++v) {
    std::sort(through[v].begin(), through[v].end());
    sharpen<Dim>(surface.vertices[v], faces, through[v]);
  }
  shrink_short_edges(surface, one_corner * solid.band);
  return surface;
}

template <int Dim>
bool cut_all(Solid<Dim>& solid, const HalfSpaces<Dim>& faces, double negligible) {
  for (int f = static_cast<int>(faces.size()) - 1; f >= 0; --f)
    if (!cut<Dim>(solid, faces[f], f, negligible)) return false;
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
  while (surface.status == SurfaceStatus::open && half < farthest * nearest) {
    half *= larger;
    surface = cut_from_box<Dim>(faces, half, negligible);
  }
  double extent = 0;
  for (const Vector<Dim>& v : surface.vertices)
    extent = std::max(extent, v.cwiseAbs().maxCoeff());
  // its own coordinates carry the rounding of the first box
  if (surface.status == SurfaceStatus::ok && half > 2 * extent)
    surface = cut_from_box<Dim>(faces, 2 * extent, negligible);
  return surface;
}

template Surface<2> find_surface<2>(const HalfSpaces<2>&, double);
template Surface<3> find_surface<3>(const HalfSpaces<3>&, double);

}  // namespace voussoir
