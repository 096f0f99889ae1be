#include "benchmarks/explicit_slicer.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace voussoir::benchmarks {
namespace {

// m: a vertex this close to a plane is on it
constexpr double on_plane = 1e-9;

struct Task {
  ExplicitBlock block;
  std::vector<int> planes;  // that may still cut it
};

bool crosses(const HalfSpace<3>& plane, const ExplicitBlock& block) {
  bool below = false, above = false;
  for (const Vector<3>& v : block.vertices) {
    const double distance = signed_distance<3>(plane, v);
    below = below || distance < -on_plane;
    above = above || distance > on_plane;
  }
  return below && above;
}

// the new face's loop about the plane's normal
std::vector<int> ring(const std::vector<Vector<3>>& points, std::vector<int> corners, const Vector<3>& normal) {
  Vector<3> middle = Vector<3>::Zero();
  for (const int c : corners)
    middle += points[c] / static_cast<double>(corners.size());
  const Vector<3> first = perpendicular(normal), second = normal.cross(first);
  const auto angle = [&](int c) { return std::atan2(second.dot(points[c] - middle), first.dot(points[c] - middle)); };
  std::sort(corners.begin(), corners.end(), [&](int a, int b) { return angle(a) < angle(b); });
  return corners;
}

// the part below the plane
ExplicitBlock below(const ExplicitBlock& block, const HalfSpace<3>& plane) {
  std::vector<double> distance;
  for (const Vector<3>& v : block.vertices)
    distance.push_back(signed_distance<3>(plane, v));
  ExplicitBlock left;
  std::vector<int> kept(block.vertices.size(), -1), rim;
  for (std::size_t v = 0; v < kept.size(); ++v) {
    if (distance[v] > on_plane) continue;
    kept[v] = static_cast<int>(left.vertices.size());
    left.vertices.push_back(block.vertices[v]);
    if (distance[v] >= -on_plane) rim.push_back(kept[v]);
  }
  std::map<std::pair<int, int>, int> made;
  const auto crossing = [&](int a, int b) {
    const std::pair<int, int> edge = std::minmax(a, b);
    const auto [at, is_new] = made.try_emplace(edge, static_cast<int>(left.vertices.size()));
    if (is_new) {
      const double fraction = distance[edge.first] / (distance[edge.first] - distance[edge.second]);
      left.vertices.push_back(block.vertices[edge.first] +
                              fraction * (block.vertices[edge.second] - block.vertices[edge.first]));
      rim.push_back(at->second);
    }
    return at->second;
  };
  for (const std::vector<int>& face : block.faces) {
    std::vector<int> loop;
    for (std::size_t k = 0; k < face.size(); ++k) {
      const int a = face[k], b = face[(k + 1) % face.size()];
      if (kept[a] >= 0) loop.push_back(kept[a]);
      if (std::min(distance[a], distance[b]) < -on_plane && std::max(distance[a], distance[b]) > on_plane)
        loop.push_back(crossing(a, b));
    }
    if (loop.size() > 2) left.faces.push_back(std::move(loop));
  }
  left.faces.push_back(ring(left.vertices, rim, plane.normal));
  return left;
}

Task task(ExplicitBlock block, const std::vector<int>& planes, std::size_t first, const HalfSpaces<3>& all) {
  Task next{std::move(block), {}};
  for (std::size_t k = first; k < planes.size(); ++k)
    if (crosses(all[planes[k]], next.block)) next.planes.push_back(planes[k]);
  return next;
}

}  // namespace

ExplicitBlock explicit_box(double h) {
  ExplicitBlock box;
  for (int i = 0; i < 8; ++i)
    box.vertices.emplace_back(i & 1 ? h : -h, i & 2 ? h : -h, i & 4 ? h : -h);
  box.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  return box;
}

std::vector<ExplicitBlock> explicit_slice(const ExplicitBlock& domain, const HalfSpaces<3>& planes) {
  std::vector<int> every;
  for (std::size_t k = 0; k < planes.size(); ++k)
    every.push_back(static_cast<int>(k));
  std::vector<ExplicitBlock> blocks;
  std::vector<Task> open{task(domain, every, 0, planes)};
  while (!open.empty()) {
    Task next = std::move(open.back());
    open.pop_back();
    if (next.planes.empty()) {
      blocks.push_back(std::move(next.block));
      continue;
    }
    const HalfSpace<3>& plane = planes[next.planes.front()];
    open.push_back(task(below(next.block, plane), next.planes, 1, planes));
    open.push_back(task(below(next.block, {-plane.normal, -plane.offset}), next.planes, 1, planes));
  }
  return blocks;
}

double explicit_volume(const ExplicitBlock& block) {
  double six = 0;
  const Vector<3>& o = block.vertices.front();
  for (const std::vector<int>& f : block.faces)
    for (std::size_t k = 1; k + 1 < f.size(); ++k)
      six += (block.vertices[f[0]] - o).dot((block.vertices[f[k]] - o).cross(block.vertices[f[k + 1]] - o));
  return six / 6;
}

}  // namespace voussoir::benchmarks
