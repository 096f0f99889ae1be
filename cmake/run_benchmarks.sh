#!/usr/bin/env bash
# run_benchmarks.sh BUILD: times the kernels; medians on the terminal, Google Benchmark's JSON in the build folder. The
# contact kernel and its peers alternate at random, so that other load on the machine affects all equally.
# Then the parts of a step other than its kernel, complete steps of piles by their parts, as a table and step.csv, sliced rock to
# equilibrium by Newton's method (statics.csv), and twenty
# thousand blocks from their fall to equilibrium with their required limits (fall.csv), which takes most of the time.
# VOUSSOIR_BENCHMARK=quick: only the contact kernel, in less than a minute, for the manual.
set -euo pipefail
build=$1
out=$build/reports/benchmarks
mkdir -p "$out"

contact=$build/benchmarks/bench_contact
if [ ! -x "$contact" ]; then
  echo "SKIPPED: Google Benchmark is not installed, nothing is timed"
  exit 0
fi
if [ "${VOUSSOIR_BENCHMARK:-}" = quick ]; then
  options=(--benchmark_repetitions=3 --benchmark_min_time=0.001)
else
  options=(--benchmark_repetitions=9 --benchmark_min_time=0.004)
  for program in "$build"/benchmarks/bench_*; do
    [ "$program" = "$contact" ] && continue
    "$program" --benchmark_repetitions=9 --benchmark_min_time=0.05 --benchmark_report_aggregates_only=true \
               --benchmark_out="$out/$(basename "$program").json" --benchmark_out_format=json
  done
  "$build/benchmarks/step_parts" "$(dirname "$0")/../cases/slicing/settling.toml" | tee "$out/step_parts.txt"
  "$build/benchmarks/pile_benchmark" "$out"
  "$build/benchmarks/statics_benchmark" "$out" | tee "$out/statics.txt"
  "$build/benchmarks/fall_benchmark" "$out" "${VOUSSOIR_FALL_BLOCKS:-20000}"
fi

"$contact" "${options[@]}" --benchmark_enable_random_interleaving=true --benchmark_report_aggregates_only=true \
  --benchmark_out="$out/bench_contact.json" --benchmark_out_format=json >"$out/bench_contact.log" 2>&1 ||
  { tail -n 20 "$out/bench_contact.log"; exit 1; }
"$build/benchmarks/voussoir_contact_report" "$out/bench_contact.json" "$out"
sha256sum <"$contact" >"$out/contact.key"
echo "make benchmark: ${VOUSSOIR_BENCHMARK:-all} timed; results: $out; $("$(dirname "$0")/seconds.sh" $SECONDS) with the build"
