#!/bin/sh
# check_verdicts.sh PROGRAM ROOT FOLDER: judges scenes in space and in the plane and checks the proofs; status 77 without Python 3
set -e
if ! command -v python3 >/dev/null; then
  echo "skipped: python3 is not installed (Debian: python3)"
  exit 77
fi
for scene in examples/tutorial/slope cases/slicing/bench cases/slicing/rock_mass examples/wet_slope docs/key_blocks examples/bolted_roof; do
  "$1" blocks "$2/$scene.toml" --out "$3/$(basename $scene)" --overwrite >/dev/null
done
exec python3 "$(dirname "$0")/check_verdicts.py" "$3"/*/blocks_verdicts.json
