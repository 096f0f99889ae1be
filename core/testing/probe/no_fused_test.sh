#!/usr/bin/env bash
# The search for fused multiply-adds finds one that is there, then none in the files given.
#   no_fused_test.sh <compiler> <scratch folder> <file> [<file> …]
set -euo pipefail
compiler=$1 scratch=$2
shift 2
here=$(dirname "$0")
mkdir -p "$scratch"
if [ "$(uname -m)" != x86_64 ]; then
  echo "skipped: the names of the instructions are those of x86-64"
  exit 77
fi

fused=$scratch/fused.o
echo 'double f(double a, double b, double c) { return a * b + c; }' |
  "$compiler" -O2 -mfma -ffp-contract=fast -c -x c++ - -o "$fused"
if "$here/no_fused.sh" "$fused" >/dev/null; then
  echo "FAILED: an object made with -mfma -ffp-contract=fast passed as free of fused multiply-adds"
  exit 1
fi
"$here/no_fused.sh" "$@"
