#include "core/contact/kernel/kernel.hpp"

#include <algorithm>
#include <cstddef>

// one compilation for each instruction set that is worth its size
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/contact/kernel/kernel.cpp"
#ifndef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
#endif
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/contact/kernel/first_inl.hpp"
#include "core/contact/kernel/standing_inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace voussoir {
namespace HWY_NAMESPACE {

Workspace& workspace() {
  static thread_local Workspace own;
  return own;
}

int quads_of(int planes) {
  return (planes + planes_per_quad - 1) / planes_per_quad;
}

template <int Dim>
const double* rows_of(const Polytope<Dim>& part) {
  return reinterpret_cast<const double*>(part.faces.data());
}

// numbers of planes: the parts' faces, A's first, and the padded planes
int padded(int plane, int count_a, int quads_a) {
  return plane < count_a ? plane : plane - count_a + quads_a * planes_per_quad;
}
int unpadded(int plane, int count_a, int quads_a) {
  return plane < count_a ? plane : plane + count_a - quads_a * planes_per_quad;
}

// what the records below hold side by side
template <int Dim>
constexpr bool records_are_dense() {
  using Vectors = Vector<Dim>;
  return offsetof(Pair<Dim>, offset) == offsetof(Pair<Dim>, rotation) + sizeof(Matrix<Dim>) &&
         sizeof(Pair<Dim>) >= offsetof(Pair<Dim>, rotation) + (Dim == 3 ? 12 : 8) * sizeof(double) &&
         offsetof(Proof<Dim>, axis) == offsetof(Proof<Dim>, point) + sizeof(Vectors) &&
         offsetof(Proof<Dim>, tangent) == offsetof(Proof<Dim>, axis) + sizeof(Vectors) &&
         sizeof(Proof<Dim>) >= offsetof(Proof<Dim>, point) + (Dim == 3 ? 12 : 8) * sizeof(double) &&
         sizeof(Vectors) == Dim * sizeof(double) && sizeof(Matrix<Dim>) == Dim * sizeof(Vectors);
}

// the tasks of one register; lanes beyond them repeat the first and are not good
template <class L, int Dim>
HWY_INLINE void begin(Meeting<L, Dim>& m, std::span<const KernelTask<Dim>> tasks) {
  static_assert(records_are_dense<2>() && records_are_dense<3>());
  using Real = typename L::Real;
  const double *pairs[L::width], *proofs[L::width], *numbers[L::width];
  double real[L::width];
  for (int lane = 0; lane < L::width; ++lane) {
    real[lane] = lane < static_cast<int>(tasks.size());
    const KernelTask<Dim>& task = tasks[real[lane] != 0 ? lane : 0];
    pairs[lane] = task.pair->rotation.data();
    proofs[lane] = task.contact->proof.point.data();
    numbers[lane] = &task.potential_radius;
    const Polytope<Dim>&a = *task.pair->a, &b = *task.pair->b;
    m.a.rows[lane] = rows_of(a);
    m.b.rows[lane] = rows_of(b);
    m.a.count[lane] = static_cast<int>(a.faces.size());
    m.b.count[lane] = static_cast<int>(b.faces.size());
  }
  Real pose[Dim * Dim + Dim], proof[3 * Dim], number[4];
  load_records<L>(pairs, pose);
  load_records<L>(proofs, proof);
  load_records<L>(numbers, number);
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
  m.good = L::picked(real);
  m.a.least_count = *std::min_element(m.a.count, m.a.count + L::width);
  m.b.least_count = *std::min_element(m.b.count, m.b.count + L::width);
  m.quads_a = quads_of(*std::max_element(m.a.count, m.a.count + L::width));
  m.quads = m.quads_a + quads_of(*std::max_element(m.b.count, m.b.count + L::width));
  m.at = workspace().arrays<Dim>(m.quads * planes_per_quad * L::width);
}

// what a pair's lane holds at the end
template <int Dim>
struct Answer {
  double margin, point[Dim], axis[Dim];                       // as in Proof, frame of the first body
  double world_point[Dim], world_normal[Dim], overlap, area;  // as in ContactGeometry
  double face_a, face_b, iterations, good, fallback;
};

template <class L, int Dim>
struct Results {
  using Real = typename L::Real;
  static constexpr int count = sizeof(Answer<Dim>) / sizeof(double);
  alignas(64) Answer<Dim> answers[L::width];

  HWY_INLINE Results(const Meeting<L, Dim>& m, std::span<const KernelTask<Dim>> tasks) {
    const double* axes[L::width];
    double* rows[L::width];
    for (int lane = 0; lane < L::width; ++lane) {
      axes[lane] = tasks[lane < static_cast<int>(tasks.size()) ? lane : 0].pair->axes.data();
      rows[lane] = reinterpret_cast<double*>(&answers[lane]);
    }
    Real columns[Dim * Dim], values[count];
    load_records<L>(axes, columns);
    Components<Real, Dim> world[Dim];
    for (int j = 0; j < Dim; ++j)
      for (int i = 0; i < Dim; ++i)
        world[i][j] = columns[j * Dim + i];
    const Components<Real, Dim> normal = unit_again<L>(from_frame(m.frame, m.normal));
    int next = 0;
    const auto add = [&](const Real& x) HWY_ATTR { values[next++] = x; };
    add(m.least - m.rounding);
    for (int k = 0; k < Dim; ++k)
      add(m.point[k]);
    for (int k = 0; k < Dim; ++k)
      add(normal[k]);
    for (int i = 0; i < Dim; ++i)
      add(dot(world[i], m.point));
    for (int i = 0; i < Dim; ++i)
      add(dot(world[i], normal));
    add(m.overlap);
    add(m.area);
    add(m.face_a);
    add(m.face_b);
    add(m.iterations);
    add(select(m.good, L::real(1), L::real(0)));
    add(select(m.fallback, L::real(1), L::real(0)));
    store_records<L>(values, rows);
  }

  // into the task's contact
  void deliver(int lane, KernelTask<Dim>& task, const SectionList& list, int quads_a, KernelCounters& counters) const {
    const Pair<Dim>& pair = *task.pair;
    const Answer<Dim>& answer = answers[lane];
    counters.newton_iterations += static_cast<long long>(answer.iterations);
    if (answer.good == 0) return;
    task.answered = true;
    Contact<Dim>& contact = *task.contact;
    Proof<Dim>& proof = contact.proof;
    ContactGeometry<Dim>& geometry = contact.geometry;
    contact.status = ContactStatus::touching;
    proof.kind = ProofKind::interior_point;
    proof.margin = answer.margin;
    std::copy_n(answer.point, Dim, proof.point.data());
    std::copy_n(answer.world_point, Dim, geometry.point.data());
    if (pair.last < Stage::overlap) return;
    std::copy_n(answer.axis, Dim, proof.axis.data());
    std::copy_n(answer.world_normal, Dim, geometry.normal.data());
    geometry.overlap = answer.overlap;
    geometry.face_a = static_cast<int>(answer.face_a);
    geometry.face_b = static_cast<int>(answer.face_b);
    counters.normal_fallbacks += answer.fallback != 0;
    counters.deep_overlaps += answer.overlap > task.potential_radius;
    geometry.area = answer.area;
    if (pair.last < Stage::area) return;
    ++counters.areas;
    if (!list.found_anew) return;
    const int count_a = static_cast<int>(pair.a->faces.size());
    proof.section_size = list.size;
    for (int k = 0; k < list.size; ++k) {
      const int plane = unpadded(list.planes[k], count_a, quads_a);
      if (plane > std::numeric_limits<unsigned short>::max()) proof.section_size = 0;
      proof.section[k] = static_cast<unsigned short>(plane);
    }
  }
};

template <int Dim>
HWY_INLINE void recall_section(const KernelTask<Dim>& task, int quads_a, SectionList& list) {
  const Proof<Dim>& proof = task.contact->proof;
  const int count_a = static_cast<int>(task.pair->a->faces.size());
  list.size = proof.section_size;
  for (int k = 0; k < list.size; ++k)
    list.planes[k] = padded(proof.section[k], count_a, quads_a);
}

// as many tasks as the register holds pairs, or fewer, all to be resolved to the same stage
template <class L, int Dim>
void standing_group(std::span<KernelTask<Dim>> tasks, const KernelOptions& options, KernelCounters& counters) {
  Meeting<L, Dim> m;
  SectionList lists[L::width];
  begin<L, Dim>(m, tasks);
  const Stage last = tasks[0].pair->last;
  if (Dim == 3 && last == Stage::area)
    for (int lane = 0; lane < static_cast<int>(tasks.size()); ++lane)
      recall_section(tasks[lane], m.quads_a, lists[lane]);
  resolve_from_point(m, last, options.newton_tolerance, options.newton_limit, lists);
  const Results<L, Dim> results(m, tasks);
  for (int lane = 0; lane < static_cast<int>(tasks.size()); ++lane)
    results.deliver(lane, tasks[lane], lists[lane], m.quads_a, counters);
}

template <int Dim>
HWY_NOINLINE void standing(std::span<KernelTask<Dim>> tasks, const KernelOptions& options, KernelCounters& counters) {
  constexpr std::size_t width = ManyPairs::width;
  while (!tasks.empty()) {
    std::size_t count = 1;
    while (count < std::min(width, tasks.size()) && tasks[count].pair->last == tasks[0].pair->last)
      ++count;
    if (count == 1)
      standing_group<OnePair, Dim>(tasks.first(count), options, counters);
    else
      standing_group<ManyPairs, Dim>(tasks.first(count), options, counters);
    tasks = tasks.subspan(count);
  }
}

template <int Dim>
HWY_NOINLINE void first(KernelTask<Dim>& task, const KernelOptions& options, KernelCounters& counters) {
  const Pair<Dim>& pair = *task.pair;
  Contact<Dim>& contact = *task.contact;
  Proof<Dim>& proof = contact.proof;
  proof = {};
  const Polytope<Dim>&a = *pair.a, &b = *pair.b;
  Meeting<OnePair, Dim> m;
  const bool a_smaller = a.radius < b.radius;
  proof.point = a_smaller ? a.centre : Vector<Dim>(pair.offset + pair.rotation * b.centre);
  begin<OnePair, Dim>(m, std::span<const KernelTask<Dim>>(&task, 1));

  // the LP in A's axes, seen from the centre of the smaller part
  for (int i = 0; i < Dim; ++i)
    for (int k = 0; k < Dim; ++k)
      m.frame[i][k] = i == k;
  assemble_planes(m);
  TightPlanes<Dim> tight;
  for (int k = 0; k <= Dim; ++k) {
    if (a.basis[k] < 0) return;
    tight.planes[k] = a.basis[k];
    tight.offsets[k] = m.at.slack[a.basis[k]];
    for (int j = 0; j <= Dim; ++j)
      tight.inverse[k][j] = a.basis_inverse(k, j);
  }
  Components<double, Dim> x;
  double bound = 0;
  int pivots = 0;
  const Decision decision = decide(m, tight, 4 * std::min(a.radius, b.radius), x, bound, pivots);
  ++counters.lp_solves;
  counters.lp_pivots += pivots;
  if (decision == Decision::unknown) return;

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
  clear(m);
  build_frame(m);
  turn_planes(m, x);
  if (none(m.good) || !(m.least > m.rounding + m.tolerance)) return;
  SectionList list;
  if (pair.last > Stage::decision) {
    // what fails from here on has the LP's point to fall back on
    proof.kind = ProofKind::interior_point;
    proof.margin = m.least - m.rounding;
    for (int k = 0; k < Dim; ++k)
      proof.point[k] = m.point[k];
    const int approaches = approach_centre(m);
    if (approaches < 0) return;
    counters.newton_iterations += approaches;

    // from here the axes fit to where the point is now
    const Components<double, Dim> origin{};
    axis = nearest_face(m, origin);
    const Components<double, Dim> tangent = thinnest_across(m, axis, origin);
    m.point = m.point + from_frame(m.frame, m.moved);
    m.axis = from_frame(m.frame, axis);
    m.tangent = from_frame(m.frame, tangent);
    resolve_from_point(m, pair.last, options.newton_tolerance, options.newton_limit, &list);
  }
  for (int k = 0; k < Dim; ++k)
    proof.tangent[k] = m.tangent[k];
  const Results<OnePair, Dim> results(m, std::span<const KernelTask<Dim>>(&task, 1));
  results.deliver(0, task, list, m.quads_a, counters);
}

void Standing2(std::span<KernelTask<2>> t, const KernelOptions& o, KernelCounters& c) {
  standing<2>(t, o, c);
}
void Standing3(std::span<KernelTask<3>> t, const KernelOptions& o, KernelCounters& c) {
  standing<3>(t, o, c);
}
void First2(KernelTask<2>& t, const KernelOptions& o, KernelCounters& c) {
  first<2>(t, o, c);
}
void First3(KernelTask<3>& t, const KernelOptions& o, KernelCounters& c) {
  first<3>(t, o, c);
}
int Width() {
  return ManyPairs::width;
}

}  // namespace HWY_NAMESPACE
}  // namespace voussoir
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace voussoir {

HWY_EXPORT(Standing2);
HWY_EXPORT(Standing3);
HWY_EXPORT(First2);
HWY_EXPORT(First3);
HWY_EXPORT(Width);

int kernel_width() {
  return HWY_DYNAMIC_DISPATCH(Width)();
}

template <>
void resolve_standing<2>(std::span<KernelTask<2>> tasks, const KernelOptions& options, KernelCounters& counters) {
  HWY_DYNAMIC_DISPATCH(Standing2)(tasks, options, counters);
}
template <>
void resolve_standing<3>(std::span<KernelTask<3>> tasks, const KernelOptions& options, KernelCounters& counters) {
  HWY_DYNAMIC_DISPATCH(Standing3)(tasks, options, counters);
}
template <>
void resolve_new<2>(KernelTask<2>& task, const KernelOptions& options, KernelCounters& counters) {
  HWY_DYNAMIC_DISPATCH(First2)(task, options, counters);
}
template <>
void resolve_new<3>(KernelTask<3>& task, const KernelOptions& options, KernelCounters& counters) {
  HWY_DYNAMIC_DISPATCH(First3)(task, options, counters);
}

}  // namespace voussoir
#endif
