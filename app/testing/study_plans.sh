#!/usr/bin/env bash
# study_plans.sh PROGRAM SOURCE SCRATCH [full]: plans every study of the cases, which reads and checks the scene of each row.
# `make reports` runs them; an error in a scene or rule must show before. The tunnel's rock mass has so many blocks that
# cutting them anew for each row took most of the time: a thirteenth of its joints is enough here, but for `full`.
set -uo pipefail
program=$1 source=$2 scratch=$3 size=${4:-few_joints}
faults=0 planned=0
rm -rf "$scratch"
mkdir -p "$scratch"
(cd "$source" && cp --parents cases/*/*.toml "$scratch")
if [ "$size" = few_joints ]; then
  rock=$scratch/cases/tunnel/rock.toml
  sed -i -E 's/^intensity = 1\.3\b/intensity = 0.1/' "$rock"
  [ "$(grep -cE '^intensity = 0\.1\b' "$rock")" -eq 3 ] || { echo "$source/cases/tunnel/rock.toml: not three sets of intensity 1.3" >&2; exit 1; }
fi
for study in "$scratch"/cases/*/*study.toml; do
  rm -rf "$scratch/plan"
  printed=$("$program" study plan "$study" --out "$scratch/plan" 2>&1) || { echo "$study: $printed" >&2; faults=$((faults + 1)); }
  planned=$((planned + 1))
done
[ $planned -gt 20 ] || { echo "only $planned studies were found" >&2; exit 1; }
echo "$planned studies planned, $faults refused"
exit $((faults > 0))
