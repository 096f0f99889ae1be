// The fast road through the contact kernel: SIMD, chosen at run time for the machine's instruction set. It answers what
// it can prove; what it cannot goes to the general road (narrow_phase.cpp).
#pragma once

#include <span>

#include "core/contact/narrow_phase.hpp"

namespace voussoir {

// one pair on its way through the kernel
template <int Dim>
struct KernelTask {
  const Pair<Dim>* pair = nullptr;
  Contact<Dim>* contact = nullptr;
  double potential_radius = 0;  // m
  double tolerance = 0;         // m: overlaps below it are none
  double reach = 0;             // m: the larger of the parts' radii
  double unused = 0;            // the four are loaded together
  bool answered = false;        // status, proof and geometry are set
};

struct KernelOptions {
  double newton_tolerance = 0;
  int newton_limit = 0;
};

// pairs that one call of resolve_standing handles at once, on this machine
int kernel_width();

// Contacts that touched before: Newton from the old point, then what Pair::last asks for. Any number of tasks; the same
// bits in any company.
template <int Dim>
void resolve_standing(std::span<KernelTask<Dim>> tasks, const KernelOptions& options, KernelCounters& counters);

// A pair of which nothing is known: the LP, then the same from its point.
template <int Dim>
void resolve_new(KernelTask<Dim>& task, const KernelOptions& options, KernelCounters& counters);

}  // namespace voussoir
