#!/usr/bin/env bash
# The cost of identical bits: seconds of the probe (core/testing/probe) built with the project's flags and with flags that give up identical
# bits. Prints medians of the processor seconds of 9 alternating runs, so that other load affects all alike.
#   price_of_determinism.sh <source> <folder for the builds> [<compiler>]
set -euo pipefail
source=$1 folder=$2 compiler=${3:-g++}
steps=2000 repetitions=9

build() { # <name> <flags> [<cmake's options> …]
  local name=$1 flags=$2
  shift 2
  cmake -S "$source" -B "$folder/$name" -G Ninja -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_COMPILER="$compiler" \
    -DCMAKE_CXX_FLAGS="$flags" -DVOUSSOIR_NUMERICS_ONLY=ON -DVOUSSOIR_BUILD_TESTS=OFF -DVOUSSOIR_BUILD_BENCHMARKS=OFF \
    -DVOUSSOIR_WITH_GLPK=OFF "$@" >/dev/null
  cmake --build "$folder/$name" --target voussoir_probe >/dev/null
}
# -U removes the macro that disables Eigen's own vector code
build ours "-O2"
build contracted "-O3 -march=native -UEIGEN_DONT_VECTORIZE" -DVOUSSOIR_ARITHMETIC="-ffp-contract=fast;-ftree-vectorize"
build fast_math "-O3 -march=native -UEIGEN_DONT_VECTORIZE" -DVOUSSOIR_ARITHMETIC="-ffast-math;-ftree-vectorize"

running=()
for name in ours contracted fast_math; do
  if "$folder/$name/core/voussoir_probe" --steps 1 >/dev/null 2>"$folder/$name/error.txt"; then
    running+=("$name")
  else
    echo "$name fails: $(tail -n 1 "$folder/$name/error.txt")"
  fi
done
for ((i = 0; i < repetitions; ++i)); do
  for name in "${running[@]}"; do
    TIMEFORMAT=%U
    { time "$folder/$name/core/voussoir_probe" --steps $steps >"$folder/$name/lines.txt"; } 2>>"$folder/$name/seconds.$$"
  done
done
for name in "${running[@]}"; do
  echo "$name $(sort -n "$folder/$name/seconds.$$" | sed -n "$((repetitions / 2 + 1))p") s, $(tail -n 1 "$folder/$name/lines.txt")"
  rm "$folder/$name/seconds.$$"
done
