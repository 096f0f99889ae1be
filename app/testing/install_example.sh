#!/usr/bin/env bash
# Installs into a scratch prefix, runs a scene by the program that lies there, and builds the example against the
# library that does, by CMake plainly, by pkg-config with -march=native.
set -euo pipefail
build=$1 source=$2 scratch=$3 compiler=$4
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
