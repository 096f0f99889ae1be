#!/bin/sh
# check_limit_proofs.sh PROGRAM ROOT FOLDER [long]: proves load factors in the plane and in space and checks the proofs; with `long` of
# large models, without tampered copies; status 77 without Python 3
set -e
if ! command -v python3 >/dev/null; then
  echo "skipped: python3 is not installed (Debian: python3)"
  exit 77
fi
prove() {
  while read -r name scene load options; do
    "$1" limit "$2/cases/$scene.toml" --load "$load" $options --with-dilation --proof --out "$3/$name" --overwrite --quiet
  done
}
check=$(dirname "$0")/check_limit_proof.py
if [ "$4" = long ]; then
  # the rock mass without its eastern and southern wall, which lie below its floor
  prove "$@" <<END
beds vaiont/beds_40 right
beds_left vaiont/beds_40 left
rock slicing/rock_mass east --set=blocks.east.box={min=[5,-1,-3],max=[6,5,-2]} --set=blocks.south.box={min=[0,-1,-3],max=[5,0,-2]}
END
  exec python3 "$check" "$3"/*/proof.json.gz
fi
prove "$@" <<END
arch arch/scene right
quarter_point arch/quarter_point left
overhang overhang/scene east
columns toppling/columns right
toppling toppling/scene north
stack column/scene west
water vaiont/scene right
incline incline/scene south
inclined limit_space/incline applied
beside limit_space/column east
pushed pushed_column/scene applied
dam water/dam left
wet_wedge key_blocks/wet_wedge south
wedge key_blocks/hoek_and_bray south
slump slump/scene right --set=joint_properties.rock.friction_deg=20
slice slump/slice east --set=joint_properties.rock.friction_deg=20
END
exec python3 "$check" --tamper "$3"/*/proof.json.gz
