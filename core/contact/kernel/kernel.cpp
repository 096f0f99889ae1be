#include "core/contact/kernel/kernel.hpp"

#include <algorithm>
#include <cstddef>

#include "core/contact/extended_precision_overlap.hpp"

// one compilation for each instruction set that is worth its size
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/contact/kernel/kernel.cpp"
#ifndef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
#endif
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/contact/kernel/central_inl.hpp"
#include "core/contact/kernel/cold_start_inl.hpp"
#include "core/contact/kernel/warm_start_inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace voussoir {
namespace HWY_NAMESPACE {

HWY_INLINE Workspace& workspace() {
  static thread_local Workspace own;
  return own;
}

// a plane's number among the parts' faces, A's first, from that among the padded planes
HWY_INLINE int unpadded(int plane, int count_a, int quads_a) {
  return plane < count_a ? plane : plane + count_a - quads_a * planes_per_quad;
}

// the fields that the records below have side by side
template <int Dim>
constexpr bool records_are_dense() {
  using Vectors = Vector<Dim>;
  return offsetof(Pair<Dim>, offset) == offsetof(Pair<Dim>, rotation) + sizeof(Matrix<Dim>) &&
         sizeof(Pair<Dim>) >= offsetof(Pair<Dim>, rotation) + (Dim == 3 ? 12 : 8) * sizeof(double) &&
         offsetof(Proof<Dim>, axis) == offsetof(Proof<Dim>, point) + sizeof(Vectors) &&
         offsetof(Proof<Dim>, tangent) == offsetof(Proof<Dim>, axis) + sizeof(Vectors) &&
         sizeof(Proof<Dim>) >= offsetof(Proof<Dim>, point) + (Dim == 3 ? 12 : 8) * sizeof(double) &&
         offsetof(Proof<Dim>, point) == offsetof(Proof<Dim>, margin) + sizeof(double) &&
         offsetof(ContactGeometry<Dim>, normal) == offsetof(ContactGeometry<Dim>, point) + sizeof(Vectors) &&
         offsetof(ContactGeometry<Dim>, overlap) == offsetof(ContactGeometry<Dim>, normal) + sizeof(Vectors) &&
         offsetof(ContactGeometry<Dim>, area) == offsetof(ContactGeometry<Dim>, overlap) + sizeof(double) &&
         offsetof(KernelTask<Dim>, tolerance) == offsetof(KernelTask<Dim>, potential_radius) + sizeof(double) &&
         offsetof(KernelTask<Dim>, reach) == offsetof(KernelTask<Dim>, tolerance) + sizeof(double) &&
         offsetof(KernelTask<Dim>, smoothing) == offsetof(KernelTask<Dim>, reach) + sizeof(double) &&
         sizeof(Vectors) == Dim * sizeof(double) && sizeof(Matrix<Dim>) == Dim * sizeof(Vectors);
}

// lanes beyond the tasks repeat the first
template <class Task>
HWY_INLINE Task& task_of(std::span<Task> tasks, int lane) {
  return tasks[lane < static_cast<int>(tasks.size()) ? lane : 0];
}

// the tasks of one register; lanes beyond them are not good
template <class L, int Dim>
HWY_INLINE void begin(Batch<L, Dim>& m, std::span<const KernelTask<Dim>> tasks, Workspace& work) {
  static_assert(records_are_dense<2>() && records_are_dense<3>());
  const double *pairs[L::width], *proofs[L::width], *numbers[L::width];
  int least_a = tasks[0].planes_a, most_a = least_a, least_b = tasks[0].planes_b, most_b = least_b;
  for (int lane = 0; lane < L::width; ++lane) {
    const KernelTask<Dim>& task = task_of(tasks, lane);
    pairs[lane] = task.pair->rotation.data();
    proofs[lane] = task.contact->proof.point.data();
    numbers[lane] = &task.potential_radius;
    m.a.rows[lane] = task.faces_a->normal.data();
    m.b.rows[lane] = task.faces_b->normal.data();
    m.a.count[lane] = task.planes_a;
    m.b.count[lane] = task.planes_b;
    least_a = std::min(least_a, task.planes_a);
    least_b = std::min(least_b, task.planes_b);
    most_a = std::max(most_a, task.planes_a);
    most_b = std::max(most_b, task.planes_b);
  }
  const Records<L, Dim * Dim + Dim> pose(pairs);
  const Records<L, 3 * Dim> proof(proofs);
  const Records<L, 4> number(numbers);
  for (int j = 0; j < Dim; ++j)
    for (int i = 0; i < Dim; ++i)
      m.rotation[i][j] = pose[j * Dim + i];
  for (int k = 0; k < Dim; ++k) {
    m.offset[k] = pose[Dim * Dim + k];
    m.point[k] = proof[k];
    m.axis[k] = proof[Dim + k];
    m.tangent[k] = proof[2 * Dim + k];
  }
  m.potential_radius = number[0];
  m.tolerance = number[1];
  m.reach = number[2];
  m.smoothing = number[3];
  m.good = L::first(static_cast<int>(tasks.size()));
  m.a.least_count = least_a;
  m.b.least_count = least_b;
  m.quads_a = quads_of(most_a);
  m.quads = m.quads_a + quads_of(most_b);
  m.part[0] = L::slots(0, most_a);
  m.part[1] = L::slots(m.quads_a, most_b);
  m.numbers = work.room(Batch<L, Dim>::room(m.quads));
}

// the numbers of the result in the records of a contact's proof and geometry, from `margin` and from `point` on
inline constexpr int proof_numbers = 8;
template <int Dim>
inline constexpr int geometry_numbers = Dim == 3 ? 8 : 4;

// the results into the tasks' contacts
template <bool OnPath, class L, int Dim>
HWY_INLINE void deliver(const Batch<L, Dim>& m, QueryLevel level, std::span<KernelTask<Dim>> tasks,
                        const SectionList* lists, KernelCounters& counters) {
  using Real = typename L::Real;
  constexpr int width = L::width;
  double good[width];
  L::put(select(m.good, L::real(1), L::real(0)), good);
  // lanes without a result write to unused memory
  double nowhere[8];
  const double* axes[width];
  double *proofs[width], *geometries[width];
  for (int lane = 0; lane < width; ++lane) {
    const KernelTask<Dim>& task = task_of(tasks, lane);
    axes[lane] = task.pair->axes.data();
    proofs[lane] = good[lane] != 0 ? &task.contact->proof.margin : nowhere;
    geometries[lane] = good[lane] != 0 ? task.contact->geometry.point.data() : nowhere;
  }
  const Records<L, Dim * Dim> columns(axes);
  Components<Real, Dim> world[Dim];
  for (int j = 0; j < Dim; ++j)
    for (int i = 0; i < Dim; ++i)
      world[i][j] = columns[j * Dim + i];
  const bool measured = level >= QueryLevel::overlap;
  const Components<Real, Dim> normal = measured ? unit_again<L>(from_frame(m.frame, m.normal)) : m.axis;

  const Real margin = m.least - m.rounding;
  Real proof[proof_numbers], geometry[geometry_numbers<Dim> + 2];
  proof[0] = margin;
  for (int k = 0; k < Dim; ++k) {
    proof[1 + k] = m.point[k];
    proof[1 + Dim + k] = normal[k];
  }
  for (int k = 1 + 2 * Dim; k < proof_numbers; ++k)
    proof[k] = k < 1 + 3 * Dim ? m.tangent[k - 1 - 2 * Dim] : L::real(0);
  store_records<L, proof_numbers>(proof, proofs);
  for (int k = 0; k < Dim; ++k) {
    geometry[k] = dot(world[k], m.point);
    geometry[Dim + k] = dot(world[k], normal);
  }
  geometry[2 * Dim] = m.overlap;
  geometry[2 * Dim + 1] = m.area;
  store_records<L, geometry_numbers<Dim>>(geometry, geometries);

  counters.newton_iterations += static_cast<long long>(L::total(m.iterations));
  if (level == QueryLevel::area) counters.areas += L::count(m.good);
  if (measured) {
    counters.normal_fallbacks += L::count(both(m.good, m.fallback));
    counters.deep_overlaps += L::count(both(m.good, m.overlap > m.potential_radius));
  }
  double face_a[width], face_b[width], overlap[width], area[width], margins[width];
  L::put(m.face_a, face_a);
  L::put(m.face_b, face_b);
  L::put(m.overlap, overlap);
  L::put(m.area, area);
  L::put(margin, margins);
  for (int lane = 0; lane < static_cast<int>(tasks.size()); ++lane) {
    if (good[lane] == 0) continue;
    KernelTask<Dim>& task = tasks[lane];
    Contact<Dim>& contact = *task.contact;
    task.answered = true;
    contact.status = ContactStatus::touching;
    contact.proof.kind = ProofKind::interior_point;
    if constexpr (Dim == 2) {
      contact.geometry.overlap = overlap[lane];
      contact.geometry.area = area[lane];
    }
    if (!measured) continue;
    contact.geometry.face_a = static_cast<int>(face_a[lane]);
    contact.geometry.face_b = static_cast<int>(face_b[lane]);
    task.magnified = !OnPath && magnified(overlap[lane], margins[lane]);
    if (Dim == 2 || level < QueryLevel::area) continue;
    const SectionList& list = lists[lane];
    if (!list.found_again) continue;
    contact.proof.section_size = list.size;
    for (int k = 0; k < list.size; ++k) {
      const int plane = unpadded(list.planes[k], task.planes_a, m.quads_a);
      if (plane > std::numeric_limits<unsigned short>::max()) contact.proof.section_size = 0;
      contact.proof.section[k] = static_cast<unsigned short>(plane);
    }
  }
}

template <class L, int Dim>
HWY_INLINE void deliver_stiffness_factor(const Batch<L, Dim>& m, std::span<KernelTask<Dim>> tasks) {
  double stiffness_factor[L::width];
  L::put(m.stiffness_factor, stiffness_factor);
  for (std::size_t lane = 0; lane < tasks.size(); ++lane)
    if (tasks[lane].answered) tasks[lane].contact->geometry.stiffness_factor = stiffness_factor[lane];
}

// the largest distance between points of the part
template <class L, int Dim>
HWY_INLINE void load_diameters(Batch<L, Dim>& m, std::span<const KernelTask<Dim>> tasks) {
  m.diameter[0] = L::collect([&](int lane) { return 2 * task_of(tasks, lane).pair->a->radius; });
  m.diameter[1] = L::collect([&](int lane) { return 2 * task_of(tasks, lane).pair->b->radius; });
}

// the list of the step before, by the padded planes' numbers; numbers behind its end in the proof are read and dropped
HWY_INLINE void recall_section(const KernelTask<3>& task, int quads_a, SectionList& list) {
  using Kept = decltype(Proof<3>::section);
  using Plane = Kept::value_type;
  static_assert(sizeof(Proof<3>) >=
                offsetof(Proof<3>, section) + std::tuple_size_v<decltype(SectionList::planes)> * sizeof(Plane));
  const hn::CappedTag<int, 8> d;
  const hn::Rebind<Plane, decltype(d)> kept;
  const Kept& section = task.contact->proof.section;
  list.size = task.contact->proof.section_size;
  const auto size = hn::Set(d, list.size), first = hn::Set(d, static_cast<int>(section[0]));
  const auto last_of_a = hn::Set(d, task.planes_a - 1), apart = hn::Set(d, quads_a * planes_per_quad - task.planes_a);
  for (std::size_t k = 0; k < list.planes.size(); k += hn::Lanes(d)) {
    const auto own = hn::PromoteTo(d, hn::LoadU(kept, section.data() + k));
    const auto plane = hn::IfThenElse(hn::Lt(hn::Iota(d, static_cast<int>(k)), size), own, first);
    hn::StoreU(hn::Add(plane, hn::IfThenElseZero(hn::Gt(plane, last_of_a), apart)), d, list.planes.data() + k);
  }
}

// as many tasks as the register holds pairs, or fewer, all to be resolved to the same level
template <bool OnPath, class L, int Dim>
void persistent_group(std::span<KernelTask<Dim>> tasks, const KernelOptions& options, Workspace& work,
                      KernelCounters& counters) {
  Batch<L, Dim> m;
  SectionList lists[L::width];
  begin<L, Dim>(m, tasks, work);
  const QueryLevel level = tasks[0].pair->level;
  if constexpr (Dim == 3) {
    if (level == QueryLevel::area)
      for (int lane = 0; lane < L::width; ++lane)
        recall_section(task_of(tasks, lane), m.quads_a, lists[lane]);
  }
  if constexpr (OnPath) {
    load_diameters<L, Dim>(m, tasks);
    resolve_on_central_path(m, level, options.newton_tolerance, options.newton_limit, lists);
  } else {
    resolve_from_point(m, level, options.newton_tolerance, options.newton_limit, lists);
  }
  deliver<OnPath>(m, level, tasks, lists, counters);
  if (OnPath && level >= QueryLevel::overlap) deliver_stiffness_factor(m, tasks);
}

template <bool OnPath, int Dim>
void persistent_groups(std::span<KernelTask<Dim>> tasks, const KernelOptions& options, KernelCounters& counters) {
  constexpr std::size_t width = ManyPairs::width;
  Workspace& work = workspace();
  while (!tasks.empty()) {
    std::size_t count = 1;
    while (count < std::min(width, tasks.size()) && tasks[count].pair->level == tasks[0].pair->level)
      ++count;
    if (count == 1)
      persistent_group<OnPath, OnePair, Dim>(tasks.first(count), options, work, counters);
    else
      persistent_group<OnPath, ManyPairs, Dim>(tasks.first(count), options, work, counters);
    tasks = tasks.subspan(count);
  }
}

template <int Dim>
HWY_NOINLINE void persistent_contacts(std::span<KernelTask<Dim>> tasks, const KernelOptions& options,
                                      KernelCounters& counters) {
  if (options.on_central_path)
    persistent_groups<true>(tasks, options, counters);
  else
    persistent_groups<false>(tasks, options, counters);
}

// A decision needs no more than some point inside; from the level of points on, the program's own point leads to the
// centre. Blocks that are nearly as close as their inscribed balls allow mostly meet on the line between the origins of
// their frames, which are their centroids; parts of a clump, whose origin is elsewhere, go on to the program.
template <int Dim>
HWY_INLINE bool decided_on_line(Batch<OnePair, Dim>& m, KernelTask<Dim>& task, KernelCounters& counters) {
  const Pair<Dim>& pair = *task.pair;
  const double radii = pair.a->inscribed_radius + pair.b->inscribed_radius;
  if (pair.offset.squaredNorm() > most_distant * (radii * radii)) return false;
  Components<double, Dim> x;
  double worst;
  if (!meets_on_line(m, x, worst)) return false;
  m.least = -worst;
  m.rounding = rounding_after(m, x);
  m.point = m.point + x;
  clear(m);
  SectionList none;
  deliver<false>(m, QueryLevel::decision, std::span<KernelTask<Dim>>(&task, 1), &none, counters);
  return true;
}

template <int Dim>
HWY_NOINLINE void new_contact(KernelTask<Dim>& task, const KernelOptions& options, KernelCounters& counters) {
  const Pair<Dim>& pair = *task.pair;
  Contact<Dim>& contact = *task.contact;
  Proof<Dim>& proof = contact.proof;
  const Polytope<Dim>&a = *pair.a, &b = *pair.b;
  Batch<OnePair, Dim> m;
  const bool a_smaller = a.radius < b.radius;
  proof.point = a_smaller ? a.centre : Vector<Dim>(pair.offset + pair.rotation * b.centre);
  begin<OnePair, Dim>(m, std::span<const KernelTask<Dim>>(&task, 1), workspace());

  // the LP in A's axes, seen from the centre of the smaller part
  assemble_in_first(m);
  if (pair.level == QueryLevel::decision && decided_on_line(m, task, counters)) return;
  TightPlanes<Dim> tight;
  for (int k = 0; k <= Dim; ++k) {
    if (a.basis[k] < 0) return;
    tight.planes[k] = a.basis[k];
    const auto column = a.basis_inverse.col(k);
    tight.inverse[k] = OnePair::of([&](int plane) { return plane <= Dim ? column[plane] : 0; });
  }
  tight.offsets = OnePair::of([&](int plane) { return plane <= Dim ? m.number(m.slack_at, a.basis[plane]) : 0; });
  Components<double, Dim> x;
  double worst = 0, bound = 0;
  int pivots = 0;
  // a decision needs no more than some point inside
  const double enough = pair.level == QueryLevel::decision ? 0 : well_inside;
  const Decision decision = decide(m, tight, 4 * std::min(a.radius, b.radius), enough, x, worst, bound, pivots);
  ++counters.lp_solves;
  counters.lp_pivots += pivots;
  if (decision == Decision::unknown) return;

  const auto certified = [&] { return m.least > m.rounding + m.tolerance; };
  SectionList list;
  if (decision == Decision::touching && pair.level == QueryLevel::decision) {
    m.least = -worst;
    m.rounding = rounding_after(m, x);
    if (!certified()) return;
    m.point = m.point + x;
    clear(m);
    return deliver<false>(m, pair.level, std::span<KernelTask<Dim>>(&task, 1), &list, counters);
  }

  Components<double, Dim> axis = axis_of(m, tight);
  const double length = root(dot(axis, axis));
  axis = length > parallel_gradients ? scaled(1 / length, axis) : nearest_face(m, x);
  for (int k = 0; k < Dim; ++k)
    proof.axis[k] = axis[k];
  if (decision == Decision::separated) {
    task.answered = true;
    contact.status = ContactStatus::separated;
    proof.kind = ProofKind::multipliers;
    proof.margin = bound;
    for (int k = 0; k <= Dim; ++k)
      proof.basis[k] = unpadded(tight.planes[k], m.a.count[0], m.quads_a);
    return;
  }

  m.axis = axis;
  m.tangent = thinnest_across(m, axis, x);
  m.point = m.point + x;
  build_frame(m);
  turn_planes(m, x);
  if (none(m.good) || !certified()) return;
  // pairs that fail from here on have the LP's point as a fallback
  proof.kind = ProofKind::interior_point;
  proof.margin = m.least - m.rounding;
  for (int k = 0; k < Dim; ++k)
    proof.point[k] = m.point[k];
  const int approaches = approach_centre(m);
  if (approaches < 0) return;
  counters.newton_iterations += approaches;

  // from here the axes fit the present position of the point
  const Components<double, Dim> origin{};
  axis = nearest_face(m, origin);
  const Components<double, Dim> tangent = thinnest_across(m, axis, origin);
  m.point = m.point + from_frame(m.frame, m.moved);
  m.axis = from_frame(m.frame, axis);
  m.tangent = from_frame(m.frame, tangent);
  resolve_from_point(m, pair.level, options.newton_tolerance, options.newton_limit, &list);
  for (int k = 0; k < Dim; ++k)
    proof.tangent[k] = m.tangent[k];
  deliver<false>(m, pair.level, std::span<KernelTask<Dim>>(&task, 1), &list, counters);
}

void Persistent2(std::span<KernelTask<2>> t, const KernelOptions& o, KernelCounters& c) {
  persistent_contacts<2>(t, o, c);
}
void Persistent3(std::span<KernelTask<3>> t, const KernelOptions& o, KernelCounters& c) {
  persistent_contacts<3>(t, o, c);
}
void New2(KernelTask<2>& t, const KernelOptions& o, KernelCounters& c) {
  new_contact<2>(t, o, c);
}
void New3(KernelTask<3>& t, const KernelOptions& o, KernelCounters& c) {
  new_contact<3>(t, o, c);
}
int Width() {
  return ManyPairs::width;
}

}  // namespace HWY_NAMESPACE
}  // namespace voussoir
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace voussoir {

HWY_EXPORT(Persistent2);
HWY_EXPORT(Persistent3);
HWY_EXPORT(New2);
HWY_EXPORT(New3);
HWY_EXPORT(Width);

int kernel_width() {
  return HWY_DYNAMIC_DISPATCH(Width)();
}

template <>
void resolve_persistent<2>(std::span<KernelTask<2>> tasks, const KernelOptions& options, KernelCounters& counters) {
  HWY_DYNAMIC_DISPATCH(Persistent2)(tasks, options, counters);
}
template <>
void resolve_persistent<3>(std::span<KernelTask<3>> tasks, const KernelOptions& options, KernelCounters& counters) {
  HWY_DYNAMIC_DISPATCH(Persistent3)(tasks, options, counters);
}
template <>
void resolve_new<2>(KernelTask<2>& task, const KernelOptions& options, KernelCounters& counters) {
  HWY_DYNAMIC_DISPATCH(New2)(task, options, counters);
}
template <>
void resolve_new<3>(KernelTask<3>& task, const KernelOptions& options, KernelCounters& counters) {
  HWY_DYNAMIC_DISPATCH(New3)(task, options, counters);
}

}  // namespace voussoir
#endif
