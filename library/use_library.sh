#!/usr/bin/env bash
# use_library.sh PREFIX WORK COMPILER EXAMPLE SCENE…: builds the consumer EXAMPLE (examples/library) by CMake against the library installed
# in PREFIX, static or shared, and runs it. Each scene ends in the bits of the installed program (WORK/bits.txt), with a
# checkpoint on the way. The consumer is compiled for AVX2 where the machine has it, whose wider registers change what Eigen aligns and
# how it frees it, and with WITH_PLAIN_FLAGS=yes for any machine too. Also run in a bare root (packaging/bare_root.sh).
set -euo pipefail
prefix=$1 work=$2 compiler=$3 example=$4
shift 4
mkdir -p "$work"
cd "$work"
for scene in "$@"; do
  "$prefix/bin/voussoir" run "$scene" --out bits --overwrite --quiet
  sed -n 's/.*"state_hash": "\(.*\)".*/\1/p' bits/results.json
done >bits.txt
test "$(grep -c fnv1a64 bits.txt)" = $#

# $1: flags of the machine
check() {
  rm -rf consumer results
  cmake -S "$example" -B consumer -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=Release \
        -DCMAKE_CXX_FLAGS="$1" >cmake.log || { cat cmake.log; exit 1; }
  cmake --build consumer >build.log || { cat build.log; exit 1; }
  consumer/uses_voussoir "${@:2}" >consumer.txt || { cat consumer.txt; exit 1; }
  cat consumer.txt
  grep -o 'fnv1a64:[0-9a-f]*' consumer.txt | cmp - bits.txt
  grep -q 'two cubes overlap by 0.010000 m over 0.900000 m2' consumer.txt
  for scene in "${@:2}"; do
    test -s "results/$(basename "$scene" .toml)/checkpoint"
  done
}
wide=
if grep -qw avx2 /proc/cpuinfo && grep -qw fma /proc/cpuinfo; then wide="-mavx2 -mfma"; fi
check "$wide" "$@"
if [ -n "$wide" ] && [ -n "${WITH_PLAIN_FLAGS:-}" ]; then check "" "$@"; fi
