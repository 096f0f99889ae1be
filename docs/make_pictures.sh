#!/usr/bin/env bash
# make_pictures.sh PROGRAM [NAME …]       makes the pictures of README.md, of these pages and of examples again, or those that are
#                                         named: docs/pictures/*, and their rows of docs/pictures.csv
# make_pictures.sh PROGRAM --into FOLDER  makes them all in FOLDER (make reports), and names those that differ from docs/pictures
# make_pictures.sh PROGRAM --table        prints the rows of all pictures as the scenes are now, and makes no picture
# SVG files are drawn by the program or are figures of its reports, PNG files are posters of its viewer (node, chromium). A row of the table has the picture, its
# scene, the keys that are set, and the input hash of that scene when the picture was made.
set -euo pipefail
program=$(realpath "$1")
shift
into="" names=() only_table=""
case ${1:-} in
  --into) mkdir -p "$2" && into=$(realpath "$2") ;;
  --table) only_table=yes ;;
  *) names=("$@") ;;
esac
cd "$(dirname "$0")/.."
pictures=docs/pictures table=docs/pictures.csv
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# input_hash SCENE [--set KEY=VALUE …]: of a study that of its scene, with the study's text
input_hash() {
  local base
  base=$(sed -n 's/^scene = "\(.*\)"$/\1/p' "$1")
  if [ -n "$base" ]; then
    { "$program" check --hash "$(dirname "$1")/$base" && cat "$1"; } | sha256sum | cut -c 1-32
  else
    "$program" check --hash "$@"
  fi
}

# row PICTURE SCENE [KEY=VALUE …]: writes its row; 1: the picture is not to be made
row() {
  local picture=$1 scene=$2 name=${1%.*} sets=() hash
  echo "$name" >>"$work/known"
  if [ ${#names[@]} -gt 0 ] && [[ " ${names[*]} " != *" $name "* ]]; then
    grep "^$picture," $table >>"$work/rows" || true
    return 1
  fi
  for key in "${@:3}"; do sets+=(--set "$key"); done
  hash=$(input_hash "$scene" "${sets[@]}") || exit 1
  echo "$picture,$scene,${*:3},$hash" >>"$work/rows"
  [ -z "$only_table" ]
}

# quietly COMMAND …: what it prints is shown if it fails
quietly() { "$@" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }; }

# drawn NAME FILE COMMAND SCENE [OPTION …]: FILE of the command's results, an SVG file
drawn() {
  row "$1.svg" "$4" || return 0
  quietly "$program" "${@:3}" --out "$work/$1"
  cp "$work/$1/$2" "${into:-$pictures}/$1.svg"
}

# reported NAME FIGURE COMMAND SCENE [OPTION …]: a figure of the report on the command's results
reported() {
  row "$1.svg" "$4" || return 0
  quietly "$program" "${@:3}" --out "$work/$1"
  quietly "$program" report "$work/$1"
  node viewer/poster.mjs "$work/$1/report.html" "${into:-$pictures}/$1.svg" "figure=$2"
}

# poster NAME COMMAND SCENE LOOK SIZE [KEY=VALUE …]: the viewer at LOOK (viewer/README.md) of a run or slice; SIZE: WIDTHxHEIGHT
poster() {
  local sets=()
  row "$1.png" "$3" "${@:6}" || return 0
  for key in "${@:6}"; do sets+=(--set "$key"); done
  quietly "$program" "$2" "$3" "${sets[@]}" --view --out "$work/$1"
  node viewer/poster.mjs "$work/$1/view.html" "${into:-$pictures}/$1.png" "$4" "${5%x*}" "${5#*x}"
}

echo picture,scene,set,input_hash >"$work/rows"
drawn arch limit.svg limit cases/arch/scene.toml
drawn gate limit.svg limit examples/gate.toml --load right
drawn joint_sets limit.svg limit examples/joint_sets.toml
reported stereonet poles slice docs/slicing.toml --report
reported block_sizes block-sizes slice docs/slicing.toml --report
drawn joint_laws joint_test.svg joint-test docs/joint_laws.toml --stress 1e6 --stress 2e6 --slip 5e-3 --steps 60
reported wet_slope_study sample-1-histogram study examples/wet_slope_study.toml --quiet
reported tutorial_poles poles slice examples/tutorial/slope.toml --report
poster slab run docs/scenes.toml 'frame=9999&forces=arrows' 760x440
poster wedge run examples/wedge.toml 'frame=9&magnified=10&colour=displacement&forces=arrows' 760x440
poster column run docs/faces.toml 'frame=9999&magnified=300&colour=displacement&forces=arrows' 760x440
poster excavation run docs/excavation.toml 'frame=9999&magnified=300&colour=displacement' 460x300
poster supports run docs/supports.toml 'frame=9999&forces=network&forceSize=0.3' 460x330
poster wet_slope run examples/wet_slope.toml 'frame=9999&colour=displacement&forces=arrows' 760x440
poster bolted_roof run examples/bolted_roof.toml 'frame=9999&forces=arrows' 620x360
poster shaken_block run examples/shaken_block.toml 'frame=9999&colour=displacement' 620x360
poster tutorial_blocks slice examples/tutorial/slope.toml 'frame=0' 620x380
poster tutorial run examples/tutorial/slope.toml 'frame=9999&magnified=10&colour=displacement&forces=arrows' 620x380
poster tutorial_weaker run examples/tutorial/slope.toml 'frame=9999&magnified=100&colour=friction' 620x380 \
  stage.safety.friction.clay.friction_deg=25

for name in "${names[@]}"; do
  grep -qx -- "$name" "$work/known" || { echo "make_pictures.sh: no picture has the name $name"; exit 2; }
done
if [ -n "$only_table" ]; then
  cat "$work/rows"
elif [ -z "$into" ]; then
  cp "$work/rows" $table
else
  cp "$work/rows" "$into/pictures.csv"
  for picture in "$into"/*.svg "$into"/*.png; do
    cmp -s "$picture" "$pictures/$(basename "$picture")" || echo "picture $(basename "$picture"): not the bytes of that in $pictures"
  done
fi
