#!/usr/bin/env bash
# run.sh BUILD TARGET short|long: replays the corpus and the cases' scenes, then fuzzes: 20 s from a fixed seed, or
# VOUSSOIR_FUZZ_SECONDS (3600) from any. Inputs that break something are left in BUILD/findings.
set -euo pipefail
build=$1 target=$2 length=$3
here=$(cd "$(dirname "$0")" && pwd)
program=$build/fuzz/fuzz_$target work=$build/corpus/$target
if [ ! -x "$program" ]; then
  echo "skipped: $program was not built"
  exit 77
fi

# a finding must not pass for a skip, whose code is libFuzzer's own for a crash
options=(-error_exitcode=1 -timeout=20 -rss_limit_mb=2048 -verbosity=0 -print_final_stats=1)  # a hang of one second ends the target itself
if [ "$target" = scene ]; then
  seeds=$(find "$here/../cases" "$here/../app/testing" -name '*.toml' ! -name study.toml | sort | paste -sd, -)
  options+=(-dict="$here/scene.dict" -seed_inputs="$seeds" -max_len=6000)
elif [ "$target" = import ]; then
  options+=(-max_len=6000)
else
  options+=(-max_len=120)
fi
if [ "$length" = short ]; then
  rm -rf "$work"
  options+=(-max_total_time=20 -seed=1)
else
  options+=(-max_total_time="${VOUSSOIR_FUZZ_SECONDS:-3600}")
fi
mkdir -p "$work" "$build/findings"
exec "$program" "${options[@]}" -artifact_prefix="$build/findings/$target-" "$work" "$here/corpus/$target"
