#!/usr/bin/env bash
# study_plans.sh PROGRAM SOURCE SCRATCH: plans every study of the cases, which reads and checks the scene of each row.
# `make reports` runs them; an error in a scene or rule must show before.
set -uo pipefail
program=$1 source=$2 scratch=$3
faults=0 planned=0
for study in "$source"/cases/*/*study.toml; do
  rm -rf "$scratch"
  printed=$("$program" study plan "$study" --out "$scratch" 2>&1) || { echo "$study: $printed" >&2; faults=$((faults + 1)); }
  planned=$((planned + 1))
done
[ $planned -gt 20 ] || { echo "only $planned studies were found" >&2; exit 1; }
echo "$planned studies planned, $faults refused"
exit $((faults > 0))
