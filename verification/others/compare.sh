#!/usr/bin/env bash
# compare.sh BUILD JOBS: builds the adapters whose engines are found, writes the problems, runs every engine with one setting for everything
# and with the best of each problem, judges the answers, and writes the table: BUILD/others/out/others.html, results.md (which
# is kept in this folder), error_against_cost.svg.
set -euo pipefail
build=$(cd "$1" && pwd) jobs=$2
here=$(cd "$(dirname "$0")" && pwd)
folder=$build/others
problems=$folder/problems out=$folder/out program=$build/app/voussoir
python=/usr/bin/python3  # the system's own, for which Debian builds the modules
export PYTHONDONTWRITEBYTECODE=1
mkdir -p "$folder"

"$here/build.sh" "$folder/adapters"
rm -rf "$problems" "$out" "$folder/judged"
"$build/verification/voussoir_problems" "$problems" >"$folder/problems.log"
mapfile -t engines < <("$python" "$here/run.py" "$problems" "$folder/adapters" "$program" "$out" --list)
others=$(printf '%s\n' "${engines[@]}" | grep -vc '^voussoir' || true)
if [ "$others" -lt 5 ]; then
  echo "make others: only $others engines besides voussoir found; see the lines above" >&2
  exit 1
fi
for settings in one best; do
  printf '%s\n' "${engines[@]}" | xargs -P "$jobs" -I{} sh -c "'$python' '$here/run.py' '$problems' '$folder/adapters' '$program' '$out' \
    --engine {} --settings $settings >'$folder/{}_$settings.log' 2>&1 || { cat '$folder/{}_$settings.log' >&2; exit 255; }"
done

# exit code 1: a quantity fails, which is what the table is for
"$program" judge "$out" --references "$problems" --out "$folder/judged" >"$folder/judge.log" 2>&1 || [ $? -eq 1 ] || {
  tail -n 20 "$folder/judge.log" >&2
  exit 1
}
"$python" "$here/table.py" "$folder/judged/judgement.csv" "$problems" "$folder/adapters" "$program" "$out"
count=$(find "$problems" -name blocks.json | wc -l)
echo "make others: $others engines and voussoir answered $count problems; table: $out/others.html; $("$here/../../cmake/seconds.sh" $SECONDS)"
