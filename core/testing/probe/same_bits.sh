#!/usr/bin/env bash
# Builds a program, core/voussoir_probe or benchmarks/kernel_answers, with a compiler and flags of its own and compares the
# lines it prints with those of a reference; then searches it for fused multiply-adds. Skipped by name (77) if the
# compiler does not support this.
#   same_bits.sh <source> <folder> <reference program> <program> <compiler> <flags> <options of both> [<run> …]
# A run is a list of further arguments of this build's program, such as "--threads 4"; without one it runs once.
set -euo pipefail
source=$1 folder=$2 reference=$3 program=$4 compiler=$5 flags=$6 options=$7
shift 7
[ $# -gt 0 ] || set -- ""
case $program in
  core/*) part=(-DVOUSSOIR_NUMERICS_ONLY=ON -DVOUSSOIR_BUILD_BENCHMARKS=OFF) ;;
  # so few sources read their headers in less time than it takes to precompile them
  *) part=(-DVOUSSOIR_NUMERICS_ONLY=kernel -DVOUSSOIR_BUILD_BENCHMARKS=ON -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON) ;;
esac
mkdir -p "$folder"

# shellcheck disable=SC2086 # flags and options are lists of words
if ! command -v "$compiler" >/dev/null || ! echo 'int main() {}' | "$compiler" $flags -x c++ - -o "$folder/can_build" 2>/dev/null; then
  echo "skipped: $compiler with flags '$flags' is not available here"
  exit 77
fi

# The numerics alone, with the project's own flags: none is written here. A build type would bring its own -O.
cmake -S "$source" -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_CXX_FLAGS="$flags" -DVOUSSOIR_BUILD_TESTS=OFF "${part[@]}" -DVOUSSOIR_WITH_GLPK=OFF >"$folder/configure.txt"
cmake --build "$folder" --target "$(basename "$program")" --parallel "${BUILD_JOBS:-1}" >"$folder/build.txt" 2>&1 ||
  { cat "$folder/build.txt"; exit 1; }

# shellcheck disable=SC2086
"$reference" $options >"$folder/expected.txt"
lines=$(wc -l <"$folder/expected.txt")
for run in "$@"; do
  # shellcheck disable=SC2086
  "$folder/$program" $options $run >"$folder/found.txt" || { status=$?; tail -n 1 "$folder/found.txt"; exit $status; }
  if ! diff "$folder/expected.txt" "$folder/found.txt"; then
    echo "FAILED: $compiler $flags ${run:+($run) }differs from $reference"
    exit 1
  fi
  echo "$compiler $flags ${run:+($run) }gives the same $lines lines"
done
"$(dirname "$0")/no_fused.sh" "$folder/$program"
