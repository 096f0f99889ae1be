#include "core/scene/bodies.hpp"

#include <algorithm>

#include "core/scene/particles.hpp"
#include "core/slicing/block.hpp"

namespace voussoir {
namespace {

// a stated corner is a corner of the hull if one is this near, relative to the block's extent: far above the rounding
// of coordinates, far below the distance of two intended corners
constexpr double same_corner = 1e-6;

// an unnamed normal of any length; the offset moves with the origin
template <int Dim>
HalfSpace<Dim> to_half_space(const BlockPlaneSpec& plane, const Vector<Dim>& origin) {
  const Vector<Dim> normal = to_vector<Dim>(plane.normal);
  const double offset =
      plane.point ? normal.dot(to_vector<Dim>(*plane.point) - origin) : *plane.offset - normal.dot(origin);
  return {normal, offset};
}

template <int Dim>
std::vector<Vector<Dim>> corners(const BlockSpec& block, const Vector<Dim>& origin) {
  std::vector<Vector<Dim>> points;
  for (const std::vector<double>& v : block.vertices)
    points.push_back(to_vector<Dim>(v) - origin);
  return points;
}

// a point that the scene states on a solid, and its key
template <int Dim>
struct StatedPoint {
  Vector<Dim> point;
  std::string path;
};

template <int Dim>
std::vector<StatedPoint<Dim>> stated_points(const Scene& scene) {
  std::vector<StatedPoint<Dim>> points;
  const auto add = [&](const std::vector<double>& point, const std::string& path) {
    points.push_back({to_vector<Dim>(point), path});
  };
  const auto add_box = [&](const BoxSpec& box, const Subject& subject) {
    add(box.min, key_path(subject.path, "box.min"));
    add(box.max, key_path(subject.path, "box.max"));
  };
  if (scene.domain && scene.domain->box) add_box(*scene.domain->box, scene.domain->subject);
  if (scene.domain)
    for (const DomainPlaneSpec& p : scene.domain->planes)
      add(p.plane.point, key_path(p.subject.path, "point"));
  for (const BlockSpec& block : scene.blocks) {
    for (const std::vector<double>& v : block.vertices)
      add(v, key_path(block.subject.path, "vertices"));
    if (block.box) add_box(*block.box, block.subject);
    if (block.particle.centre) add(*block.particle.centre, key_path(block.subject.path, "centre"));
    for (const BlockPlaneSpec& p : block.planes) {
      const Vector<Dim> normal = to_vector<Dim>(p.normal);
      if (p.point)
        add(*p.point, key_path(p.subject.path, "point"));
      else
        points.push_back(
            {Vector<Dim>(*p.offset / normal.squaredNorm() * normal), key_path(p.subject.path, "normal and offset")});
    }
  }
  return points;
}

template <int Dim>
Vector<Dim> middle(const std::vector<Vector<Dim>>& points) {
  if (points.empty()) return Vector<Dim>::Zero();
  Vector<Dim> low = points.front(), high = points.front();
  for (const Vector<Dim>& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return low + 0.5 * (high - low);
}

// the statement that is reported if a solid is far from all others
template <int Dim>
std::string farthest_statement(const Scene& scene) {
  const std::vector<StatedPoint<Dim>> points = stated_points<Dim>(scene);
  const auto size = [](const StatedPoint<Dim>& p) { return p.point.cwiseAbs().maxCoeff(); };
  return std::max_element(points.begin(), points.end(), [&](const auto& p, const auto& q) { return size(p) < size(q); })
      ->path;
}

template <int Dim>
Polytope<Dim> checked(const Scene& scene, const BlockResult<Dim>& result, const Node& node, const std::string& path,
                      const char* what) {
  switch (result.status) {
    case BlockStatus::ok:
      return result.part;
    case BlockStatus::open:
      refuse(node, path,
             std::string("the planes do not close a region, the ") + what +
                 " is open; add the missing planes, or reverse one that points the wrong way");
    case BlockStatus::empty:
      refuse(node, path,
             std::string("no point is inside all planes, the ") + what +
                 " is empty; reverse the plane that points the wrong way, or move "
                 "one");
    case BlockStatus::flat:
      break;
    case BlockStatus::far:
      refuse(node, path,
             std::string("the ") + what +
                 " is so far from the middle of the scene that its coordinates are rounded by more than 1e-6 of its "
                 "size; move the solids "
                 "together, or make it larger (the largest coordinate is that of " +
                 farthest_statement<Dim>(scene) + ")");
    case BlockStatus::bad_plane:
      refuse(node, path + "." + std::to_string(result.plane + 1), "is not a plane; give a normal that is not zero");
  }
  refuse(node, path,
         std::string("the ") + what +
             " has no volume, or is thinner than 1e-8 of its length; move its planes (offset, point) or corners apart");
}

template <int Dim>
void check_corners(const BlockSpec& block, const std::vector<Vector<Dim>>& points, const Polytope<Dim>& part) {
  double extent = 0;
  for (const Vector<Dim>& p : points)
    extent = std::max(extent, (p - points.front()).norm());
  const Node& list = *block.subject.node->find("vertices");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool found = std::any_of(part.vertices.begin(), part.vertices.end(), [&](const Vector<Dim>& v) {
      return (v - points[i]).norm() <= same_corner * extent;
    });
    if (!found)
      refuse(
          list.items[i], key_path(block.subject.path, "vertices") + "." + std::to_string(i + 1),
          "is not a corner of the convex hull: blocks are convex and every vertex must be a corner; remove or move it, "
          "or split the block into convex ones");
  }
}

template <int Dim>
Polytope<Dim> make_hull(const Scene& scene, const BlockSpec& block, const Vector<Dim>& origin) {
  const Node& node = *block.subject.node->find("vertices");
  const std::string path = key_path(block.subject.path, "vertices");
  const std::vector<Vector<Dim>> points = corners<Dim>(block, origin);
  const std::string flat = Dim == 3 ? "the block has no volume; give at least 4 points that are not in one plane"
                                    : "the block has no area; give at least 3 points that are not on one line";
  if (points.size() <= Dim) refuse(node, path, flat);
  const HalfSpaces<Dim> planes = hull_planes<Dim>(points);
  if (planes.empty()) refuse(node, path, flat);
  const BlockResult<Dim> result = make_block<Dim>(planes, std::vector<int>(planes.size(), no_joint));
  if (result.status == BlockStatus::far) checked<Dim>(scene, result, node, path, "block");
  if (result.status != BlockStatus::ok) refuse(node, path, flat);
  check_corners<Dim>(block, points, result.part);
  return result.part;
}

bool has_planes(const Scene& scene) {
  return (scene.domain && !scene.domain->planes.empty()) ||
         std::any_of(scene.blocks.begin(), scene.blocks.end(), [](const BlockSpec& b) { return !b.planes.empty(); });
}

}  // namespace

// the offset of a plane with a known point is n·x0 (Eq. 3.6)
template <>
HalfSpace<3> to_half_space(const PlaneSpec& plane, const Vector<3>& origin) {
  const Vector<3> normal =
      plane.normal.empty() ? upward_normal_3d(plane.dip, plane.dip_direction) : to_vector<3>(plane.normal);
  return {normal, normal.dot(to_vector<3>(plane.point) - origin)};
}

template <>
HalfSpace<2> to_half_space(const PlaneSpec& plane, const Vector<2>& origin) {
  const Vector<2> normal =
      plane.normal.empty() ? upward_normal_2d(plane.dip, plane.dip_direction) : to_vector<2>(plane.normal);
  return {normal, normal.dot(to_vector<2>(plane.point) - origin)};
}

template <int Dim>
HalfSpaces<Dim> box_planes(const BoxSpec& box, const Vector<Dim>& origin) {
  HalfSpaces<Dim> planes;
  const Vector<Dim> low = to_vector<Dim>(box.min) - origin, high = to_vector<Dim>(box.max) - origin;
  for (int k = 0; k < Dim; ++k) {
    planes.push_back({-Vector<Dim>::Unit(k), -low[k]});
    planes.push_back({Vector<Dim>::Unit(k), high[k]});
  }
  return planes;
}

template <int Dim>
Vector<Dim> find_origin(const Scene& scene) {
  std::vector<Vector<Dim>> points;
  for (const StatedPoint<Dim>& p : stated_points<Dim>(scene))
    points.push_back(p.point);
  const Vector<Dim> first = middle<Dim>(points);
  if (!has_planes(scene)) return first;

  // the points of planes may be anywhere on them: a second check, of the resulting solids
  points.clear();
  const auto add = [&](const Polytope<Dim>& part) {
    points.insert(points.end(), part.vertices.begin(), part.vertices.end());
  };
  if (scene.domain) add(make_domain<Dim>(scene, first));
  for (const BlockSpec& block : scene.blocks)
    add(make_solid<Dim>(scene, block, first));
  return first + middle<Dim>(points);
}

template <int Dim>
Polytope<Dim> make_domain(const Scene& scene, const Vector<Dim>& origin) {
  const DomainSpec& domain = *scene.domain;
  HalfSpaces<Dim> planes;
  if (domain.box) planes = box_planes<Dim>(*domain.box, origin);
  for (const DomainPlaneSpec& spec : domain.planes) {
    const HalfSpace<Dim> plane = to_half_space<Dim>(spec.plane, origin);
    planes.push_back(spec.keep_below ? plane : HalfSpace<Dim>{-plane.normal, -plane.offset});
  }
  const BlockResult<Dim> result = make_block<Dim>(planes, std::vector<int>(planes.size(), no_joint));
  return checked<Dim>(scene, result, *domain.subject.node, domain.subject.path, "domain");
}

template <int Dim>
Polytope<Dim> make_solid(const Scene& scene, const BlockSpec& block, const Vector<Dim>& origin) {
  if (block.subject.node->find("vertices")) return make_hull<Dim>(scene, block, origin);
  HalfSpaces<Dim> planes;
  if (block.box) planes = box_planes<Dim>(*block.box, origin);
  for (const BlockPlaneSpec& plane : block.planes)
    planes.push_back(to_half_space<Dim>(plane, origin));
  if (block.shape == BlockShape::potential) return make_particle_part<Dim>(block, std::move(planes), origin);
  const BlockResult<Dim> result = make_block<Dim>(planes, std::vector<int>(planes.size(), no_joint));
  const char* key = block.box ? "box" : "planes";
  return checked<Dim>(scene, result, *block.subject.node->find(key), key_path(block.subject.path, key), "block");
}

template HalfSpaces<2> box_planes<2>(const BoxSpec&, const Vector<2>&);
template HalfSpaces<3> box_planes<3>(const BoxSpec&, const Vector<3>&);
template Vector<2> find_origin<2>(const Scene&);
template Vector<3> find_origin<3>(const Scene&);
template Polytope<2> make_domain<2>(const Scene&, const Vector<2>&);
template Polytope<3> make_domain<3>(const Scene&, const Vector<3>&);
template Polytope<2> make_solid<2>(const Scene&, const BlockSpec&, const Vector<2>&);
template Polytope<3> make_solid<3>(const Scene&, const BlockSpec&, const Vector<3>&);

}  // namespace voussoir
