// libccd over the vertices of the parts, in the frame of the first.
#include <ccd/ccd.h>
#include <ccd/quat.h>

#include "benchmarks/peers/peers.hpp"

namespace voussoir::benchmarks {
namespace {

// lengths are about 1, overlaps about 1e-4: its default tolerance of 1e-4 would miss them
constexpr double length_tolerance = 1e-6;

struct Body {
  const Polytope<3>* part;
  Matrix<3> rotation;
  Vector<3> position;
};

void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* result) {
  const Body& body = *static_cast<const Body*>(object);
  const Vector<3> local =
      body.rotation.transpose() * Vector<3>(ccdVec3X(direction), ccdVec3Y(direction), ccdVec3Z(direction));
  const Vector<3>* best = body.part->vertices.data();
  double furthest = local.dot(*best);
  for (const Vector<3>& v : body.part->vertices) {
    const double reach = local.dot(v);
    if (reach > furthest) {
      furthest = reach;
      best = &v;
    }
  }
  const Vector<3> p = body.rotation * *best + body.position;
  ccdVec3Set(result, p[0], p[1], p[2]);
}

void centre(const void* object, ccd_vec3_t* result) {
  const Vector<3>& p = static_cast<const Body*>(object)->position;
  ccdVec3Set(result, p[0], p[1], p[2]);
}

ccd_t settings() {
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = ccd.support2 = support;
  ccd.center1 = ccd.center2 = centre;
  ccd.max_iterations = 200;
  ccd.epa_tolerance = ccd.mpr_tolerance = ccd.dist_tolerance = length_tolerance;
  return ccd;
}

using Query = bool (*)(const Body& a, const Body& b, const ccd_t& ccd);

std::shared_ptr<Prepared> prepare(const Workload& work, Query query) {
  std::vector<std::pair<Body, Body>> bodies;
  for (const Pair<3>& pair : work.pairs)
    bodies.push_back({{pair.a, Matrix<3>::Identity(), Vector<3>::Zero()}, {pair.b, pair.rotation, pair.offset}});
  return prepared_query(pairs_per_workload, [bodies, query, ccd = settings()](std::size_t i) {
    return query(bodies[i].first, bodies[i].second, ccd);
  });
}

bool gjk(const Body& a, const Body& b, const ccd_t& ccd) {
  return ccdGJKIntersect(&a, &b, &ccd) != 0;
}

bool epa(const Body& a, const Body& b, const ccd_t& ccd) {
  ccd_real_t depth;
  ccd_vec3_t direction, position;
  return ccdGJKPenetration(&a, &b, &ccd, &depth, &direction, &position) == 0;
}

bool mpr(const Body& a, const Body& b, const ccd_t& ccd) {
  ccd_real_t depth;
  ccd_vec3_t direction, position;
  return ccdMPRPenetration(&a, &b, &ccd, &depth, &direction, &position) == 0;
}

Method method(const char* name, const char* stage, const char* delivers, bool (*applies)(PairState), Query query) {
  return {name, stage, delivers, applies, [query](const Workload& work) { return prepare(work, query); }};
}

}  // namespace

std::vector<Method> ccd_methods() {
  return {method(ccd_gjk, "decision", "decision", any_pair, gjk),
          method(ccd_epa, "overlap", "decision point normal overlap", overlapping, epa),
          method(ccd_mpr, "overlap", "decision point normal overlap", any_pair, mpr)};
}

}  // namespace voussoir::benchmarks
