#!/usr/bin/env bash
# Installs into a scratch prefix, runs a scene by the program that lies there, and builds the example against the
# library that does, plainly and with -march=native.
set -euo pipefail
build=$1 source=$2 scratch=$3 compiler=$4
rm -rf "$scratch"
cmake --install "$build" --prefix "$scratch/prefix" >/dev/null
"$scratch/prefix/bin/voussoir" run "$(dirname "$0")/two_cubes.toml" --out "$scratch/results" --quiet
test -s "$scratch/results/results.json"
for flags in "" "-march=native"; do
  folder="$scratch/build$flags"
  cmake -S "$source" -B "$folder" -DCMAKE_PREFIX_PATH="$scratch/prefix" -DCMAKE_CXX_COMPILER="$compiler" \
        -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS="$flags" >/dev/null
  cmake --build "$folder" >/dev/null
  "$folder/sliding_block" | tee "$scratch/example$flags.txt"
done
cmp "$scratch/example.txt" "$scratch/example-march=native.txt"  # other machine flags, the same numbers
