#!/usr/bin/env bash
# Installs the built library into a scratch prefix and builds the consumer against it, plainly and with -march=native.
set -euo pipefail
build=$1 source=$2 scratch=$3 compiler=$4
rm -rf "$scratch"
cmake --install "$build" --prefix "$scratch/prefix" >/dev/null
for flags in "" "-march=native"; do
  folder="$scratch/build$flags"
  cmake -S "$source" -B "$folder" -DCMAKE_PREFIX_PATH="$scratch/prefix" -DCMAKE_CXX_COMPILER="$compiler" \
        -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS="$flags" >/dev/null
  cmake --build "$folder" >/dev/null
  "$folder/consumer"
done
