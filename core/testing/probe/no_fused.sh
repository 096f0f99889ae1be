#!/usr/bin/env bash
# Fails when an object, archive or program contains a fused multiply-add: it rounds once where the source rounds twice.
#   no_fused.sh <file> [<file> …]
# Reports only instructions that start with vfmadd, vfmsub, vfnmadd, vfnmsub, vfmaddsub, vfmsubadd (x86).
set -euo pipefail
for file in "$@"; do
  fused=$(objdump -d --no-show-raw-insn "$file" | awk '/^[0-9a-f]+ </ {at = $2} $2 ~ /^vfn?m(add|sub)/ {print at, $0}')
  if [ -n "$fused" ]; then
    echo "FAILED: $file contains $(wc -l <<<"$fused") fused multiply-adds, the first ones:"
    head -n 5 <<<"$fused"
    exit 1
  fi
  echo "no fused multiply-add in $file"
done
