// The SIMD kernel, chosen at run time for the machine's instruction set. It resolves the pairs that it can prove; the
// others go to the reference kernel (narrow_phase.cpp).
#pragma once

#include <algorithm>
#include <span>

#include "core/base/settings.hpp"
#include "core/contact/contact.hpp"
#include "core/contact/kernel_counters.hpp"
#include "core/contact/pair.hpp"

namespace voussoir {

// One pair in the kernel. Plain, so that room for many costs nothing.
template <int Dim>
struct KernelTask {
  const Pair<Dim>* pair;
  Contact<Dim>* contact;
  double potential_radius;  // m; the four numbers are loaded together
  double tolerance;         // m: smaller overlaps do not count
  double reach;             // m: the larger of the parts' radii
  double smoothing;         // m, on the central path
  const HalfSpace<Dim>*faces_a, *faces_b;
  int planes_a, planes_b;
  bool answered;   // status, proof and geometry are set
  bool magnified;  // rounding may show in the overlap (extended_precision_overlap.hpp)
};

template <int Dim>
KernelTask<Dim> kernel_task(const Pair<Dim>& pair, const ContactSettings& settings, Contact<Dim>& contact) {
  const Polytope<Dim>&a = *pair.a, &b = *pair.b;
  const double size = std::min(a.inscribed_radius, b.inscribed_radius);
  return {.pair = &pair,
          .contact = &contact,
          .potential_radius = settings.potential_radius * size,
          .tolerance = settings.tolerance * size,
          .reach = std::max(a.radius, b.radius),
          .smoothing = settings.smoothing * size,
          .faces_a = a.faces.data(),
          .faces_b = b.faces.data(),
          .planes_a = static_cast<int>(a.faces.size()),
          .planes_b = static_cast<int>(b.faces.size()),
          .answered = false,
          .magnified = false};
}

struct KernelOptions {
  double newton_tolerance = 0;
  int newton_limit = 0;
  bool on_central_path = false;  // contacts by multipliers (central_inl.hpp)
};

// pairs that one call of resolve_persistent handles together, on this machine
int kernel_width();

// Persistent contacts, which touched before: Newton from the old point (a warm start), then the results that
// Pair::level requires. Any number of tasks; the result of each is bitwise independent of the others.
template <int Dim>
void resolve_persistent(std::span<KernelTask<Dim>> tasks, const KernelOptions& options, KernelCounters& counters);

// A new contact without any known data, not even a proof: the LP (a cold start), then the same from its point.
template <int Dim>
void resolve_new(KernelTask<Dim>& task, const KernelOptions& options, KernelCounters& counters);

}  // namespace voussoir
