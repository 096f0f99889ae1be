// libccd as a kernel to be judged: GJK for decisions, the expanding polytope for contacts, with the tolerance that the
// benchmark gives it (peers/ccd.cpp).
#include <ccd/ccd.h>
#include <ccd/quat.h>

#include "benchmarks/judge/voussoir_kernel.h"

namespace {

constexpr double length_tolerance = 1e-6;
constexpr int most_iterations = 200;

struct Placed {
  const voussoir_block* block;
  const voussoir_pose* pose;  // null: the first block
};

void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* result) {
  const Placed& placed = *static_cast<const Placed*>(object);
  const double d[3] = {ccdVec3X(direction), ccdVec3Y(direction), ccdVec3Z(direction)};
  double seen[3] = {d[0], d[1], d[2]};
  if (placed.pose)
    for (int j = 0; j < 3; ++j)
      seen[j] =
          placed.pose->rotation[j] * d[0] + placed.pose->rotation[3 + j] * d[1] + placed.pose->rotation[6 + j] * d[2];
  const double* best = placed.block->vertices;
  double furthest = -1e300;
  for (int i = 0; i < placed.block->vertex_count; ++i) {
    const double* v = placed.block->vertices + 3 * i;
    const double reach = v[0] * seen[0] + v[1] * seen[1] + v[2] * seen[2];
    if (reach > furthest) furthest = reach, best = v;
  }
  double p[3] = {best[0], best[1], best[2]};
  if (placed.pose)
    for (int i = 0; i < 3; ++i) {
      const double* row = placed.pose->rotation + 3 * i;
      p[i] = row[0] * best[0] + row[1] * best[1] + row[2] * best[2] + placed.pose->position[i];
    }
  ccdVec3Set(result, p[0], p[1], p[2]);
}

}  // namespace

extern "C" {

int32_t voussoir_kernel_version(void) {
  return VOUSSOIR_KERNEL_VERSION;
}

const char* voussoir_kernel_name(void) {
  return "libccd GJK and EPA";
}

int32_t voussoir_contact(const void* first, const void* second, const voussoir_pose* pose, int32_t asked,
                         voussoir_answer* answer) {
  const Placed a{static_cast<const voussoir_block*>(first), nullptr},
      b{static_cast<const voussoir_block*>(second), pose};
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = ccd.support2 = support;
  ccd.max_iterations = most_iterations;
  ccd.epa_tolerance = length_tolerance;
  if (asked == VOUSSOIR_DECISION) {
    answer->touch = ccdGJKIntersect(&a, &b, &ccd);
    return 0;
  }
  ccd_real_t depth = 0;
  ccd_vec3_t direction, position;
  const int result = ccdGJKPenetration(&a, &b, &ccd, &depth, &direction, &position);
  if (result < -1) return result;  // no memory
  answer->touch = result == 0;
  if (!answer->touch) return 0;
  answer->has_point = answer->has_normal = 1;
  answer->overlap_kind = VOUSSOIR_SMALLEST_TRANSLATION;
  answer->overlap = depth;
  for (int k = 0; k < 3; ++k) {
    answer->point[k] = position.v[k];
    answer->normal[k] = direction.v[k];
  }
  return 0;
}
}
