// Our contact kernel behind the interface that it shares with all that are judged.
#include "benchmarks/judge/kernels.hpp"
#include "core/contact/narrow_phase.hpp"
#include "core/testing/shapes.hpp"

namespace voussoir::benchmarks {
namespace {

const void* prepare_own(const voussoir_block* block) {
  HalfSpaces<3> planes;
  for (int i = 0; i < block->plane_count; ++i) {
    const double* p = block->planes + 4 * i;
    planes.push_back({{p[0], p[1], p[2]}, p[3]});
  }
  return new Polytope<3>(shapes::block<3>(planes));
}

void release_own(const void* handle) {
  delete static_cast<const Polytope<3>*>(handle);
}

std::int32_t contact_own(const void* first, const void* second, const voussoir_pose* pose, std::int32_t asked,
                         voussoir_answer* answer) {
  Pair<3> pair;
  pair.a = static_cast<const Polytope<3>*>(first);
  pair.b = static_cast<const Polytope<3>*>(second);
  pair.axes.setIdentity();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      pair.rotation(i, j) = pose->rotation[3 * i + j];
    pair.offset[i] = pose->position[i];
  }
  pair.level = asked == VOUSSOIR_DECISION ? QueryLevel::decision : QueryLevel::overlap;
  Contact<3> contact;
  Contact<3>* const slot = &contact;
  KernelCounters counters;
  static const Solvers<3> solvers;
  narrow_phase<3>(std::span<const Pair<3>>(&pair, 1), {}, solvers, std::span<Contact<3>* const>(&slot, 1), counters);
  if (contact.status == ContactStatus::separated) return 0;
  if (!contact.touching()) return 1 + static_cast<std::int32_t>(contact.status);
  answer->touch = 1;
  if (asked == VOUSSOIR_DECISION) return 0;
  answer->has_point = answer->has_normal = 1;
  answer->overlap_kind = VOUSSOIR_ALONG_NORMAL;
  answer->overlap = contact.geometry.overlap;
  for (int k = 0; k < 3; ++k) {
    answer->point[k] = contact.geometry.point[k];
    answer->normal[k] = contact.geometry.normal[k];
  }
  return 0;
}

}  // namespace

Kernel own_kernel() {
  return {"voussoir", contact_own, prepare_own, release_own, nullptr};
}

}  // namespace voussoir::benchmarks
