#!/usr/bin/env bash
# build.sh SOURCE BUILD: builds the fuzz targets with clang; status 77 if clang++ is not installed.
set -euo pipefail
source=$1 build=$2
if ! command -v clang++ >/dev/null; then
  echo "skipped: clang++ is not installed (Debian: clang libclang-rt-14-dev)"
  exit 77
fi
cd "$source"
cmake --preset fuzz -B "$build" >"$build.log" 2>&1 || { cat "$build.log"; exit 1; }
nice cmake --build "$build" --target fuzzers --parallel 1
