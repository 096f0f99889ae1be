#!/usr/bin/env bash
# Installs into a scratch prefix, runs a scene with the installed program, and builds the example against the
# installed library, by CMake with plain flags and by pkg-config with -march=native.
set -euo pipefail
build=$1 source=$2 scratch=$3 compiler=$4 kind=${5:-}  # long: with plain flags too
rm -rf "$scratch"
cmake --install "$build" --prefix "$scratch/prefix" >/dev/null
"$scratch/prefix/bin/voussoir" run "$(dirname "$0")/two_cubes.toml" --out "$scratch/results" --quiet
test -s "$scratch/results/results.json"
cmake -S "$source" -B "$scratch/build" -DCMAKE_PREFIX_PATH="$scratch/prefix" -DCMAKE_CXX_COMPILER="$compiler" \
      -DCMAKE_BUILD_TYPE=Release >/dev/null
cmake --build "$scratch/build" >/dev/null
"$scratch/build/sliding_block" | tee "$scratch/example.txt"

# with other machine flags the same numbers
PKG_CONFIG_PATH=$(dirname "$(find "$scratch/prefix" -name voussoir.pc)")
export PKG_CONFIG_PATH
pkg-config --validate voussoir
"$compiler" -std=c++20 -O2 -march=native "$source/main.cpp" $(pkg-config --cflags --libs voussoir) -o "$scratch/sliding_block"
"$scratch/sliding_block" | tee "$scratch/example-march=native.txt"
cmp "$scratch/example.txt" "$scratch/example-march=native.txt"

# Together with another library, of other flags: its vectors arrive, and scenes end in the bits of the program.
beside=$(dirname "$0")/beside_another_library root=$(dirname "$0")/../.. scenes="$(dirname "$0")/two_squares.toml $(dirname "$0")/two_cubes.toml"
for scene in $scenes; do
  "$scratch/prefix/bin/voussoir" run "$scene" --out "$scratch/bits" --overwrite --quiet
  sed -n 's/.*"state_hash": "\(.*\)".*/\1/p' "$scratch/bits/results.json"
done >"$scratch/bits.txt"
test "$(grep -c fnv1a64 "$scratch/bits.txt")" = 2
# a public header has no Eigen that a compiler's flags align, and the interface sets no macro of Eigen
if pkg-config --cflags voussoir | grep EIGEN; then exit 1; fi
# the wider registers align what the narrower ones do, and more: the plain flags besides only in the long test
machines=-O2
if grep -qw avx2 /proc/cpuinfo && grep -qw fma /proc/cpuinfo; then machines="${kind:+-O2 }-O2,-mavx2,-mfma"; fi
for machine in $machines; do
  "$compiler" -std=c++20 ${machine//,/ } -I"$root" $(pkg-config --cflags eigen3) -c "$beside/other.cpp" -o "$scratch/other.o"
  "$compiler" -std=c++20 ${machine//,/ } -iquote "$root" $(pkg-config --cflags voussoir) "$beside/main.cpp" "$scratch/other.o" \
              $(pkg-config --libs voussoir) -o "$scratch/beside"
  # shellcheck disable=SC2086
  "$scratch/beside" $scenes >"$scratch/beside.txt" || { cat "$scratch/beside.txt"; exit 1; }
  cmp "$scratch/bits.txt" "$scratch/beside.txt"
done
