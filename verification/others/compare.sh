#!/usr/bin/env bash
# compare.sh BUILD JOBS: builds the adapters whose engines are found, writes the problems, runs every engine with one setting for everything
# and with the best of each problem, judges the answers, and writes the table: BUILD/others/out/others.html, others.md, others.csv.
set -euo pipefail
build=$(cd "$1" && pwd) jobs=$2
here=$(cd "$(dirname "$0")" && pwd)
folder=$build/others
problems=$folder/problems out=$folder/out program=$build/app/voussoir
python=/usr/bin/python3  # the system's own, for which Debian builds the modules
export PYTHONDONTWRITEBYTECODE=1
mkdir -p "$folder"

"$here/build.sh" "$folder/adapters"
rm -rf "$problems" "$out"
"$build/verification/problems/voussoir_problems" "$problems" >"$folder/problems.log"
mapfile -t engines < <("$python" "$here/run.py" "$problems" "$folder/adapters" "$program" "$out" --list)
if [ ${#engines[@]} -lt 5 ]; then
  echo "make others: only ${#engines[@]} engines found (${engines[*]}); see the lines above" >&2
  exit 1
fi
for settings in one best; do
  printf '%s\n' "${engines[@]}" | xargs -P "$jobs" -I{} sh -c "'$python' '$here/run.py' '$problems' '$folder/adapters' '$program' '$out' \
    --engine {} --settings $settings >'$folder/{}_$settings.log' 2>&1 || { cat '$folder/{}_$settings.log' >&2; exit 255; }"
done

# the references travel with the answers, which are judged as those of any code
for code in "$out"/*/; do
  for answer in "$code"*/; do
    cp "$problems/$(basename "$answer")/reference.json" "$answer"
  done
done
"$program" judge "$out"/*/ --out "$folder/judged" >"$folder/judge.log" 2>&1 || [ $? -eq 1 ] || { tail -n 20 "$folder/judge.log" >&2; exit 1; }
"$python" "$here/table.py" "$problems" "$folder/adapters" "$program" "$out"
echo "make others: ${#engines[@]} codes answered $(find "$problems" -name blocks.json | wc -l) problems; table: $out/others.html; $("$here/../../cmake/seconds.sh" $SECONDS)"
