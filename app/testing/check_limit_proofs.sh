#!/bin/sh
# check_limit_proofs.sh PROGRAM ROOT FOLDER: proves load factors in the plane and in space and checks the proofs; status 77 without Python 3
set -e
if ! command -v python3 >/dev/null; then
  echo "skipped: python3 is not installed (Debian: python3)"
  exit 77
fi
while read -r name scene load options; do
  "$1" limit "$2/$scene.toml" --load "$load" $options --proof --out "$3/$name" --overwrite --quiet
done <<END
arch cases/arch/scene right
quarter_point cases/arch/quarter_point left
overhang cases/overhang/scene east
columns cases/toppling/columns right
toppling cases/toppling/scene north
stack cases/column/scene west
water cases/vaiont/scene right
incline cases/incline/scene south
END
exec python3 "$(dirname "$0")/check_limit_proof.py" --tamper "$3"/*/proof.json.gz
