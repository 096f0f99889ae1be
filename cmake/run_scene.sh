#!/usr/bin/env bash
# run_scene.sh BUILD SCENE OUT KEY=VALUE…: runs a scene with the program of BUILD. Without SCENE it is the tutorial's slope,
# whose factor of safety is known, with its interactive page.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
program=$1/app/voussoir scene=$2 out=$3
shift 3
if [ -n "$scene" ]; then
  status=0
  "$program" run "$scene" ${out:+--out "$out"} "${@/#/--set=}" || status=$?
  echo "make run: $scene ended with exit code $status (docs/exit_codes.md); $("$here/seconds.sh" $SECONDS) with the build"
  exit $status
fi
out=${out:-results/slope}
"$program" run examples/tutorial/slope.toml --view --overwrite --out "$out" "${@/#/--set=}"
found=$(sed -nE '/"factor_of_safety": \{/,/\}/ s/.*"value": ([0-9.]+).*/\1/p' "$out/results.json" | head -n 1)
printf 'make run: a wedge on two joints, factor of safety %.4f; its closed form is 1.0694 (examples/tutorial/README.md)\n' "$found"
echo "make run: open $out/view.html; the run took $SECONDS s, $("$here/seconds.sh" $SECONDS) with the build; your own scene: 'make run SCENE=file'"
