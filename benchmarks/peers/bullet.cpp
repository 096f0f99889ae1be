// Bullet in double precision over the vertices of the parts, margins 0.
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>

#include <map>

#include "benchmarks/peers/peers.hpp"

namespace voussoir::benchmarks {
namespace {

static_assert(sizeof(btScalar) == sizeof(double));

btVector3 to_bullet(const Vector<3>& v) {
  return {v[0], v[1], v[2]};
}

std::shared_ptr<btConvexHullShape> hull(const Polytope<3>& part) {
  auto shape = std::make_shared<btConvexHullShape>();
  for (const Vector<3>& v : part.vertices)
    shape->addPoint(to_bullet(v), false);
  shape->recalcLocalAabb();
  shape->setMargin(0);
  return shape;
}

struct Placed {
  std::shared_ptr<btConvexHullShape> a, b;
  btTransform of_b;
};

std::shared_ptr<Prepared> prepare(const Workload& work) {
  std::map<const Polytope<3>*, std::shared_ptr<btConvexHullShape>> hulls;
  for (const Polytope<3>& part : *work.parts)
    hulls[&part] = hull(part);
  std::vector<Placed> placed;
  for (const Pair<3>& pair : work.pairs) {
    const Matrix<3>& r = pair.rotation;
    const btMatrix3x3 rotation(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2));
    placed.push_back({hulls[pair.a], hulls[pair.b], btTransform(rotation, to_bullet(pair.offset))});
  }
  return prepared_query(pairs_per_workload, [placed](std::size_t i) {
    const Placed& pair = placed[i];
    btGjkEpaSolver2::sResults results;
    return btGjkEpaSolver2::Penetration(pair.a.get(), btTransform::getIdentity(), pair.b.get(), pair.of_b,
                                        pair.of_b.getOrigin(), results, false);
  });
}

}  // namespace

std::vector<Method> bullet_methods() {
  return {{bullet_epa, "overlap", "decision point normal overlap", any_pair, prepare}};
}

}  // namespace voussoir::benchmarks
