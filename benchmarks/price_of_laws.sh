#!/usr/bin/env bash
# price_of_laws.sh [build]: instructions per contact that the existence of the other joint laws costs a scene of plain Coulomb joints,
# compared with a hand-written loop, those of each law, and those of complete steps, at rest and with all joints sliding. Counted, so that all machines give
# the same; needs valgrind. The set-up cancels in the difference of two numbers of calls.
set -euo pipefail
build=${1:-build}
program=$build/benchmarks/bench_joint_law
calls=200
count() {
  valgrind --tool=callgrind --callgrind-out-file=/dev/null "$program" --count "$1" "$2" 2>&1 |
    sed -n 's/.*Collected : *\([0-9]*\).*/\1/p'
}
contacts=$("$program" --benchmark_filter=by_hand --benchmark_min_time=0.01 2>/dev/null |
  sed -n 's/.*contacts=\([0-9.k]*\).*/\1/p' | head -1)
echo "contacts: $contacts"
printf '%-20s %14s %10s\n' way instructions ratio
for way in by_hand plain sub_contacts_2x2 linear_stiffness power_stiffness hardening softening bonds hyperbolic_closure dilation \
  barton_bandis mobilised_roughness {step,slide}_of_{plain,dilation,barton_bandis,mobilised_roughness}; do
  few=$(count $way 1) many=$(count $way $((calls + 1)))
  each=$(((many - few) / calls))
  [ $way = by_hand ] && hand=$each
  printf '%-20s %14d %10.4f\n' $way $each "$(echo "$each / $hand" | bc -l)"
done
