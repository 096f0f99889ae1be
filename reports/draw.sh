#!/usr/bin/env bash
# draw.sh <figure.gp> <out.svg> [name=value …]: draws one figure from the data files of the current folder.
# style.gp is run before the gnuplot file, which finds the names as string variables. gnuplot ends with status 0 when a
# data file or column is missing, so its warnings, an empty file and a cut file count as failures.
set -uo pipefail
figure=$1 out=$2
shift 2
here=$(cd "$(dirname "$0")" && pwd)
name=$(basename "$figure")
if ! command -v gnuplot >/dev/null; then
  echo "SKIPPED: gnuplot is not installed, $name is not drawn"
  exit 77
fi

mkdir -p "$(dirname "$out")"
draft=$out.draft
rm -f "$out" "$draft"
trap 'rm -f "$draft"' EXIT
variables=
for assignment in "$@"; do
  value=${assignment#*=}
  variables+="${assignment%%=*}='${value//\'/\'\'}'; "
done

messages=$(gnuplot -e "$variables" "$here/style.gp" "$figure" 2>&1 >"$draft")
status=$?
[ -n "$messages" ] && echo "$messages"
if [ $status -ne 0 ]; then
  echo "$name: gnuplot ended with status $status"
  exit 1
fi
if grep -qE 'warning:|No data in plot|line [0-9]+:|all points .* undefined' <<<"$messages"; then
  echo "$name: gnuplot warned (above): data are missing"
  exit 1
fi
if ! tail -n 3 "$draft" 2>/dev/null | grep -q '</svg>'; then
  echo "$name: the figure is empty or cut"
  exit 1
fi
mv "$draft" "$out"
