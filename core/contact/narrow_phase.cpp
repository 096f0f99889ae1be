#include "core/contact/narrow_phase.hpp"

#include <algorithm>
#include <array>

#include "core/contact/extended_precision_overlap.hpp"
#include "core/contact/kernel/kernel.hpp"
#include "core/contact/reference_kernel.hpp"
#include "core/contact/separation.hpp"

namespace voussoir {
namespace {

// whether the axis, unit and in the first body's frame, separates the parts
template <int Dim>
bool separates(const Pair<Dim>& pair, const Vector<Dim>& axis, double support_a, Contact<Dim>& contact) {
  const double gap = gap_behind(pair, axis, support_a);
  if (!(gap > 0)) return false;
  if (contact.status != ContactStatus::separated) contact.geometry = {};
  contact.status = ContactStatus::separated;
  contact.proof.kind = ProofKind::separating_axis;
  contact.proof.margin = gap;
  contact.proof.axis = axis;
  contact.proof.support = support_a;
  return true;
}

// whether the plane that separated the parts before still does
template <int Dim>
bool remains_separated(const Pair<Dim>& pair, Contact<Dim>& contact, KernelCounters& counters) {
  const Proof<Dim>& proof = contact.proof;
  if (proof.kind != ProofKind::separating_axis || !separates(pair, Vector<Dim>(proof.axis), proof.support, contact))
    return false;
  ++counters.axis_hits;
  return true;
}

// the plane between separated parts is cheaper to check next time than the multipliers that found it
template <int Dim>
void keep_axis(const Pair<Dim>& pair, Contact<Dim>& contact) {
  const Vector<Dim> axis = contact.proof.axis;
  separates(pair, axis, support(*pair.a, axis), contact);
}

bool on_central_path(const ContactSettings& settings) {
  return settings.point == ContactPoint::central_path && settings.normal == ContactNormal::multipliers;
}

template <int Dim>
bool simd_kernel_suits(const ContactSettings& settings, const Solvers<Dim>& solvers) {
  if (solvers.feasibility != &solve_feasibility<Dim>) return false;
  return on_central_path(settings) ||
         (settings.point == ContactPoint::analytic_centre && settings.normal == ContactNormal::potential &&
          settings.overlap == OverlapSearch::closed_form && solvers.centre == &solve_analytic_centre<Dim>);
}

KernelOptions kernel_options(const ContactSettings& settings) {
  return {settings.newton_tolerance, settings.newton_limit, on_central_path(settings)};
}

// whether faces of one part are facets of one face, whose weights the reference kernel knows
template <int Dim>
bool has_facets(const Pair<Dim>& pair) {
  return !pair.a->face_weights.empty() || !pair.b->face_weights.empty();
}

// by the reference kernel; parts that are separated keep the plane between them
template <int Dim>
void resolve_without_simd(const Pair<Dim>& pair, const ContactSettings& settings, const Solvers<Dim>& solvers,
                          Contact<Dim>& contact, KernelCounters& counters) {
  resolve_by_reference(pair, settings, solvers, contact, false, counters);
  if (contact.status == ContactStatus::separated) keep_axis(pair, contact);
}

// no data are known of the pair, or they are no longer valid
template <int Dim>
void resolve_cold(KernelTask<Dim>& task, const ContactSettings& settings, const Solvers<Dim>& solvers,
                  KernelCounters& counters) {
  const Pair<Dim>& pair = *task.pair;
  Contact<Dim>& contact = *task.contact;
  // then the proof contains only the start of the program
  const bool was_undecided = contact.status == ContactStatus::undecided;
  if (!was_undecided) contact.proof = {};
  ++counters.cold_starts;
  const Vector<Dim> between = pair.offset + pair.rotation * pair.b->centre - pair.a->centre;
  const double distance = between.norm();
  if (distance > 0) {
    const Vector<Dim> axis = between / distance;
    if (separates(pair, axis, support(*pair.a, axis), contact)) return;
  }
  contact.geometry = {};
  // a pair that extended precision could not decide, the SIMD kernel will not
  if (on_central_path(settings) || was_undecided || has_facets(pair))
    return resolve_without_simd(pair, settings, solvers, contact, counters);
  resolve_new(task, kernel_options(settings), counters);
  if (!task.answered) {
    const bool fresh = contact.proof.kind == ProofKind::interior_point;
    return resolve_by_reference(pair, settings, solvers, contact, fresh, counters);
  }
  if (contact.status == ContactStatus::separated) return keep_axis(pair, contact);
  if (task.magnified) measure_overlap_in_extended_precision(pair, contact);
}

// Places of some pairs, of which each fits into a byte.
struct Places {
  std::array<unsigned char, pairs_together> place;
  std::size_t count = 0;
};

// by a number of planes, all with more than `most` count as equal; equal ones stay in their order
template <class Planes>
Places sorted_by(const Places& places, const Planes& planes) {
  constexpr std::size_t most = 32;
  std::array<unsigned char, most + 2> first{};
  const auto key = [&](unsigned char place) { return std::min(planes(place), most); };
  for (std::size_t i = 0; i < places.count; ++i)
    ++first[key(places.place[i]) + 1];
  for (std::size_t k = 1; k < first.size(); ++k)
    first[k] = static_cast<unsigned char>(first[k] + first[k - 1]);
  Places sorted;
  sorted.count = places.count;
  for (std::size_t i = 0; i < places.count; ++i)
    sorted.place[first[key(places.place[i])]++] = places.place[i];
  return sorted;
}

// Pairs that need the same work side by side: a register is as slow as its largest pair.
template <int Dim>
Places sorted_by_work(std::span<const Pair<Dim>> pairs, const Places& places) {
  return sorted_by(sorted_by(places, [&](int i) { return pairs[i].b->faces.size(); }),
                   [&](int i) { return pairs[i].a->faces.size(); });
}

// at most pairs_together
template <int Dim>
void resolve_batch(std::span<const Pair<Dim>> pairs, const ContactSettings& settings, const Solvers<Dim>& solvers,
                   std::span<Contact<Dim>* const> contacts, KernelCounters& counters) {
  Places together;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Pair<Dim>& pair = pairs[i];
    Contact<Dim>& contact = *contacts[i];
    // persistent contacts are resolved together, below
    if (contact.proof.kind == ProofKind::interior_point) {
      if (has_facets(pair)) {
        resolve_without_simd(pair, settings, solvers, contact, counters);
        continue;
      }
      together.place[together.count++] = static_cast<unsigned char>(i);
      continue;
    }
    if (remains_separated(pair, contact, counters)) continue;
    KernelTask<Dim> task = kernel_task(pair, settings, contact);
    resolve_cold(task, settings, solvers, counters);
  }
  if (together.count == 0) return;

  KernelTask<Dim> tasks[pairs_together];
  const Places sorted = sorted_by_work(pairs, together);
  for (std::size_t i = 0; i < sorted.count; ++i)
    tasks[i] = kernel_task(pairs[sorted.place[i]], settings, *contacts[sorted.place[i]]);
  const std::span<KernelTask<Dim>> persistent(tasks, sorted.count);
  resolve_persistent<Dim>(persistent, kernel_options(settings), counters);
  for (KernelTask<Dim>& task : persistent) {
    if (!task.answered) {
      resolve_cold(task, settings, solvers, counters);
      continue;
    }
    ++counters.point_hits;
    if (task.magnified) measure_overlap_in_extended_precision(*task.pair, *task.contact);
  }
}

}  // namespace

template <int Dim>
void narrow_phase(std::span<const Pair<Dim>> pairs, const ContactSettings& settings, const Solvers<Dim>& solvers,
                  std::span<Contact<Dim>* const> contacts, KernelCounters& counters) {
  counters.evaluations += static_cast<long long>(pairs.size());
  if (!simd_kernel_suits(settings, solvers)) {
    for (std::size_t i = 0; i < pairs.size(); ++i)
      if (!remains_separated(pairs[i], *contacts[i], counters))
        resolve_without_simd(pairs[i], settings, solvers, *contacts[i], counters);
    return;
  }
  for (std::size_t from = 0; from < pairs.size(); from += pairs_together) {
    const std::size_t count = std::min(pairs_together, pairs.size() - from);
    resolve_batch(pairs.subspan(from, count), settings, solvers, contacts.subspan(from, count), counters);
  }
}

template void narrow_phase<2>(std::span<const Pair<2>>, const ContactSettings&, const Solvers<2>&,
                              std::span<Contact<2>* const>, KernelCounters&);
template void narrow_phase<3>(std::span<const Pair<3>>, const ContactSettings&, const Solvers<3>&,
                              std::span<Contact<3>* const>, KernelCounters&);

}  // namespace voussoir
