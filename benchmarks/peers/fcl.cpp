// FCL's collide with one contact, by its libccd solver.
#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/collision.h>

#include <map>

#include "benchmarks/peers/peers.hpp"

namespace voussoir::benchmarks {
namespace {

// Debian's library was built with Eigen's defaults, and so is this file (benchmarks/CMakeLists.txt)
static_assert(alignof(Eigen::Vector4d) == 16 && alignof(Eigen::Isometry3d) == 16);

using Convex = fcl::Convex<double>;

std::shared_ptr<const Convex> convex(const Polytope<3>& part) {
  const auto faces = std::make_shared<std::vector<int>>();
  for (const std::vector<int>& loop : part.loops) {
    faces->push_back(static_cast<int>(loop.size()));
    faces->insert(faces->end(), loop.begin(), loop.end());
  }
  const auto vertices = std::make_shared<const std::vector<fcl::Vector3d>>(part.vertices.begin(), part.vertices.end());
  return std::make_shared<const Convex>(vertices, static_cast<int>(part.loops.size()), faces);
}

struct Placed {
  std::shared_ptr<const Convex> a, b;
  fcl::Transform3d of_b;
};

std::shared_ptr<Prepared> prepare(const Workload& work) {
  std::map<const Polytope<3>*, std::shared_ptr<const Convex>> shapes;
  for (const Polytope<3>& part : *work.parts)
    shapes[&part] = convex(part);
  std::vector<Placed> placed;
  for (const Pair<3>& pair : work.pairs) {
    placed.push_back({shapes[pair.a], shapes[pair.b], fcl::Transform3d::Identity()});
    placed.back().of_b.linear() = pair.rotation;
    placed.back().of_b.translation() = pair.offset;
  }
  fcl::CollisionRequestd request(1, true);
  request.gjk_solver_type = fcl::GST_LIBCCD;
  return prepared_query(pairs_per_workload, [placed, request](std::size_t i) {
    fcl::CollisionResultd result;
    const Placed& pair = placed[i];
    return fcl::collide(pair.a.get(), fcl::Transform3d::Identity(), pair.b.get(), pair.of_b, request, result) > 0;
  });
}

}  // namespace

std::vector<Method> fcl_methods() {
  return {{fcl_contact, "overlap", "decision point normal overlap", any_pair, prepare}};
}

}  // namespace voussoir::benchmarks
