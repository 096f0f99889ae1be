#!/usr/bin/env bash
# price_of_faces.sh [build]: instructions of an integrated face contact, compared with one point with area in the kernel's batches: blocks
# on faces and on corners, sticking and sliding. Counted, so that all machines give the same; needs valgrind. The set-up cancels in the
# difference of two numbers of calls.
set -euo pipefail
build=${1:-build}
program=$build/benchmarks/bench_faces
calls=20 contacts=200
count() {
  valgrind --tool=callgrind --callgrind-out-file=/dev/null "$program" --count "$1" "$2" 2>&1 |
    sed -n 's/.*Collected : *\([0-9]*\).*/\1/p'
}
each() {
  local few many
  few=$(count "$1" 1) many=$(count "$1" $((calls + 1)))
  echo $(((many - few) / calls / contacts))
}
printf '%-20s %10s %10s %8s\n' contact point whole ratio
for kind in face face_slides corner corner_slides; do
  point=$(each $kind/point) whole=$(each $kind/whole)
  printf '%-20s %10d %10d %8.2f\n' $kind "$point" "$whole" "$(echo "$whole / $point" | bc -l)"
done
