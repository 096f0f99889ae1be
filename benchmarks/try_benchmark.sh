#!/usr/bin/env bash
# try_benchmark.sh CMAKE BUILD: builds all benchmarks, runs the contact benchmark on one shape and tabulates it; then the
# fall of two hundred blocks, and the rest of 327.
set -euo pipefail
cmake=$1 build=$2
"$cmake" --build "$build" --target benchmarks
out=$build/benchmarks/trial
mkdir -p "$out"
"$build/benchmarks/bench_contact" --benchmark_filter='^cube/' --benchmark_repetitions=2 --benchmark_min_time=0.001 \
  --benchmark_report_aggregates_only=true --benchmark_out="$out/run.json" --benchmark_out_format=json >"$out/run.log" 2>&1
"$build/benchmarks/voussoir_contact_report" "$out/run.json" "$out"
"$build/benchmarks/fall_benchmark" "$out" 200
"$build/benchmarks/statics_benchmark" "$out" "small rock mass"
