#!/usr/bin/env bash
# Runs every benchmark program: medians of repetitions on the terminal, Google Benchmark's JSON in the build folder;
# then whole steps of piles by stages, as a table and step.csv.
set -euo pipefail
build=$1
out=$build/reports/benchmarks
mkdir -p "$out"
for program in "$build"/benchmarks/bench_*; do
  name=$(basename "$program")
  "$program" --benchmark_repetitions=9 --benchmark_min_time=0.05 --benchmark_report_aggregates_only=true \
             --benchmark_out="$out/$name.json" --benchmark_out_format=json
done
"$build/benchmarks/pile_benchmark" "$out"
echo "make benchmark: done; results in $out"
