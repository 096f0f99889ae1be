#include "verification/problems/solid.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/geometry/polytope.hpp"

namespace voussoir::problems {
namespace {

constexpr double flatness = 1e-9;       // of the block's size
constexpr double exactly_along = 1e-9;  // off the diagonal, of the largest moment: axes of the world are principal

double size_of(const std::vector<Point>& vertices) {
  double size = 0;
  for (const Point& v : vertices)
    size = std::max(size, (v - vertices.front()).norm());
  return size;
}

// Newell's normal, which no single corner determines
Face face_of(const Solid& block, std::vector<int> corners) {
  Point normal = Point::Zero(), middle = Point::Zero();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Point& a = block.vertices[corners[k]];
    const Point& b = block.vertices[corners[(k + 1) % corners.size()]];
    normal += (a - block.vertices[corners[0]]).cross(b - block.vertices[corners[0]]);
    middle += a / static_cast<double>(corners.size());
  }
  normal.normalize();
  return {normal, normal.dot(middle), std::move(corners)};
}

void require_convex(const Solid& block) {
  const double allowed = flatness * size_of(block.vertices);
  for (const Face& face : block.faces) {
    for (const int c : face.corners)
      if (std::abs(face.normal.dot(block.vertices[c]) - face.offset) > allowed)
        throw std::invalid_argument("block " + block.name + ": a face is not flat");
    for (const Point& v : block.vertices)
      if (face.normal.dot(v) - face.offset > allowed)
        throw std::invalid_argument("block " + block.name + ": a corner is outside a face; is it convex?");
  }
}

// about the centre, density 1, with the centre in the world
MassProperties<3> volume_of(const Solid& block) {
  const Point origin = block.vertices.front();  // near the block: far from the world's origin digits would be lost
  std::vector<Vector<3>> local;
  for (const Point& v : block.vertices)
    local.push_back(v - origin);
  std::vector<std::vector<int>> loops;
  for (const Face& face : block.faces)
    loops.push_back(face.corners);
  MassProperties<3> volume = integrate<3>(local, loops);
  const Point centre = volume.centroid;
  volume = moved_origin<3>(volume, centre);
  volume.centroid = origin + centre;
  return volume;
}

Axes principal(const Axes& moments) {
  const Axes off = moments - Axes(moments.diagonal().asDiagonal());
  if (off.cwiseAbs().maxCoeff() < exactly_along * moments.cwiseAbs().maxCoeff()) return Axes::Identity();
  Axes axes = Eigen::SelfAdjointEigenSolver<Axes>(moments).eigenvectors();
  // each axis beside the world's axis that it is nearest to, so that a prism keeps its own; then a right-handed set
  Axes sorted = axes;
  std::array<bool, 3> taken{};
  for (int world = 0; world < 3; ++world) {
    int best = -1;
    for (int k = 0; k < 3; ++k)
      if (!taken[k] && (best < 0 || std::abs(axes(world, k)) > std::abs(axes(world, best)))) best = k;
    taken[best] = true;
    sorted.col(world) = axes(world, best) < 0 ? Point(-axes.col(best)) : Point(axes.col(best));
  }
  if (sorted.determinant() < 0) sorted.col(2) *= -1;
  return sorted;
}

}  // namespace

Solid solid(std::string name, double density, std::vector<Point> vertices, std::vector<std::vector<int>> faces,
            const std::optional<Axes>& axes) {
  Solid block;
  block.name = std::move(name);
  block.density = density;
  block.vertices = std::move(vertices);
  for (std::vector<int>& corners : faces)
    block.faces.push_back(face_of(block, std::move(corners)));
  require_convex(block);
  const MassProperties<3> volume = volume_of(block);
  const Axes moments = density * inertia_tensor(volume);
  block.mass = density * volume.volume;
  block.centre = volume.centroid;
  block.axes = axes ? *axes : principal(moments);
  const Axes own = block.axes.transpose() * moments * block.axes;
  for (int k = 0; k < 3; ++k)
    block.moments[k] = own(k, k);
  return block;
}

Solid box(std::string name, double density, const Point& least, const Point& greatest) {
  std::vector<Point> corners;
  for (int k = 0; k < 8; ++k)
    corners.emplace_back(k & 1 ? greatest[0] : least[0], k & 2 ? greatest[1] : least[1],
                         k & 4 ? greatest[2] : least[2]);
  Solid block =
      solid(std::move(name), density, corners,
            {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}, Axes::Identity());
  const Point edges = greatest - least;
  block.box = std::array{edges[0], edges[1], edges[2]};
  return block;
}

namespace {

// corners of the near end, then of the far end; the polygon is counter-clockwise seen from the near end's outside
Solid drawn_out(std::string name, double density, const std::vector<Point>& near_end, const Point& along) {
  const int n = static_cast<int>(near_end.size());
  std::vector<Point> corners = near_end;
  for (const Point& p : near_end)
    corners.push_back(p + along);
  std::vector<int> near_face, far_face;
  std::vector<std::vector<int>> faces;
  for (int k = 0; k < n; ++k) {
    near_face.push_back(k);
    far_face.push_back(2 * n - 1 - k);
    faces.push_back({k, n + k, n + (k + 1) % n, (k + 1) % n});
  }
  faces.push_back(near_face);
  faces.push_back(far_face);
  return solid(std::move(name), density, corners, faces);
}

}  // namespace

Solid prism(std::string name, double density, const std::vector<std::pair<double, double>>& polygon, double depth) {
  std::vector<Point> near_end;
  for (const auto& corner : polygon)
    near_end.emplace_back(corner.first, -depth / 2, corner.second);
  return drawn_out(std::move(name), density, near_end, Point(0, depth, 0));
}

Solid prism_along_x(std::string name, double density, const std::vector<std::pair<double, double>>& polygon,
                    double length) {
  std::vector<Point> near_end;
  for (const auto& corner : polygon)
    near_end.emplace_back(length / 2, corner.first, corner.second);
  return drawn_out(std::move(name), density, near_end, Point(-length, 0, 0));
}

Solid turned(Solid block, const Eigen::Quaterniond& turn, const Point& about) {
  const Axes r = turn.toRotationMatrix();
  for (Point& v : block.vertices)
    v = about + r * (v - about);
  for (Face& face : block.faces) {
    const Point middle = block.vertices[face.corners.front()];
    face.normal = r * face.normal;
    face.offset = face.normal.dot(middle);
  }
  block.centre = about + r * (block.centre - about);
  block.axes = r * block.axes;
  block.velocity = r * block.velocity;
  block.spin = r * block.spin;
  return block;
}

}  // namespace voussoir::problems
