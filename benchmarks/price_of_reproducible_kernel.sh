#!/usr/bin/env bash
# The cost of identical bits in the contact kernel: it is built with the project's flags and with VOUSSOIR_FAST_ARITHMETIC, timed on
# touching pairs, warm 1 %, and its results are compared. Prints geometric means over the five regular shapes of the medians of 25
# alternating runs, and the largest differences over all overlapping pairs of the benchmark.
#   price_of_reproducible_kernel.sh <source> <folder for the builds> [<compiler>]
set -euo pipefail
source=$1 folder=$2 compiler=${3:-g++}
repetitions=25

for name in reproducible fast; do
  cmake -S "$source" -B "$folder/$name" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$compiler" \
    -DVOUSSOIR_FAST_ARITHMETIC="$([ $name = fast ] && echo ON || echo OFF)" -DVOUSSOIR_BUILD_TESTS=OFF \
    -DVOUSSOIR_BUILD_BENCHMARKS=ON -DVOUSSOIR_WITH_GLPK=OFF -DVOUSSOIR_WITH_IPOPT=OFF >/dev/null
  cmake --build "$folder/$name" --target bench_contact kernel_answers --parallel "${BUILD_JOBS:-1}" >/dev/null
  "$folder/$name/benchmarks/kernel_answers" >"$folder/$name/answers.txt"
  rm -f "$folder/$name/times.txt"
done

# name,iterations,real_time,… in ns for all pairs of a workload
shapes='tetrahedron|cube|octahedron|dodecahedron|icosahedron'
for ((i = 0; i < repetitions; ++i)); do
  for name in reproducible fast; do
    "$folder/$name/benchmarks/bench_contact" --benchmark_format=csv --benchmark_min_time=0.02 \
      --benchmark_filter="^($shapes)/touch/voussoir (single|batched) warm 1 %/area" 2>/dev/null |
      sed -n 's|^"\([^/]*\)/touch/voussoir \([a-z]*\) warm[^"]*",[^,]*,\([^,]*\),.*|\2/\1 \3|p' >>"$folder/$name/times.txt"
  done
done

mean() { # <build> <single or batched>: ns of one pair
  sort -k 1,1 -k 2,2g "$folder/$1/times.txt" | awk -v way="$2" -v middle=$((repetitions / 2 + 1)) '
    index($1, way "/") != 1 {next}
    $1 != last {last = $1; k = 0}
    ++k == middle {sum += log($2 / 1000); ++shapes}
    END {if (shapes != 5) exit 1; printf "%.1f", exp(sum / shapes)}'
}
for way in single batched; do
  slow=$(mean reproducible $way) quick=$(mean fast $way)
  echo "$way: reproducible $slow ns, fast $quick ns, gain $(awk "BEGIN {printf \"%.1f\", 100 * ($slow / $quick - 1)}") %"
done

paste -d ' ' "$folder/reproducible/answers.txt" "$folder/fast/answers.txt" | awk '
  function size(x) {return x < 0 ? -x : x}
  function note(what, value) {if (value > most[what]) {most[what] = value; where[what] = $1}}
  $1 != $8 {print "FAILED: the two builds have different pairs"; failed = 1; exit 1}
  {++pairs; differ += $3 != $10 || $4 != $11 || $5 != $12 || $6 != $13 || $7 != $14}
  $2 != $9 {++decisions}
  $2 == 3 && $9 == 3 {
    note("point, fraction of the overlap", sqrt(($3 - $10) ^ 2 + ($4 - $11) ^ 2 + ($5 - $12) ^ 2) / $6)
    note("overlap, relative", size($6 - $13) / $6)
    if ($7 > 0) note("area, relative", size($7 - $14) / $7)
  }
  END {
    if (failed) exit 1
    printf "%d of %d results differ in bits, %d in the decision\n", differ, pairs, decisions
    for (what in most) printf "%s: at most %.1e (%s)\n", what, most[what], where[what]
  }'
