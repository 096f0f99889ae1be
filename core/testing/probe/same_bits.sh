#!/usr/bin/env bash
# Builds the probe with a compiler and flags of its own and compares the hashes it prints with those of a reference
# probe; then looks for fused multiply-adds in it. Skipped by name (77) where the compiler cannot do what is asked.
#   same_bits.sh <source> <folder> <reference probe> <compiler> <flags> <probe's options> <run> [<run> …]
# A run is what else this build's probe is given, such as "--threads 4"; "" for nothing.
set -euo pipefail
source=$1 folder=$2 reference=$3 compiler=$4 flags=$5 options=$6
shift 6
mkdir -p "$folder"

# shellcheck disable=SC2086 # flags and options are lists of words
if ! command -v "$compiler" >/dev/null || ! echo 'int main() {}' | "$compiler" $flags -x c++ - -o "$folder/can_build" 2>/dev/null; then
  echo "skipped: $compiler with flags '$flags' is not available here"
  exit 77
fi

# The numerics alone, with the project's own flags: none is written here. A build type would bring its own -O.
cmake -S "$source" -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_CXX_FLAGS="$flags" -DVOUSSOIR_NUMERICS_ONLY=ON -DVOUSSOIR_BUILD_TESTS=OFF -DVOUSSOIR_BUILD_BENCHMARKS=OFF \
  -DVOUSSOIR_WITH_GLPK=OFF -DVOUSSOIR_WITH_IPOPT=OFF >"$folder/configure.txt"
cmake --build "$folder" --target voussoir_probe --parallel "${BUILD_JOBS:-1}" >"$folder/build.txt" 2>&1 ||
  { cat "$folder/build.txt"; exit 1; }

probe=$folder/core/voussoir_probe
# shellcheck disable=SC2086
"$reference" $options >"$folder/expected.txt"
lines=$(grep -c fnv1a64 "$folder/expected.txt")
for run in "$@"; do
  # shellcheck disable=SC2086
  "$probe" $options $run >"$folder/found.txt" || { status=$?; tail -n 1 "$folder/found.txt"; exit $status; }
  if ! diff "$folder/expected.txt" "$folder/found.txt"; then
    echo "FAILED: $compiler $flags ($run) differs from $reference"
    exit 1
  fi
  echo "$compiler $flags ${run:+($run) }gives the same $lines hashes"
done
"$(dirname "$0")/no_fused.sh" "$probe"
