#!/usr/bin/env bash
# make_pictures.sh PROGRAM: makes the pictures of README.md, of these pages and of examples again, docs/pictures/*, from the scenes
# named here. SVG files are drawn by the program; PNG files are posters of its viewer (node, chromium).
set -euo pipefail
program=$(realpath "$1")
cd "$(dirname "$0")/.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
pictures=docs/pictures

# drawn NAME FILE COMMAND …: FILE of the command's results, an SVG file
drawn() {
  local name=$1 file=$2
  shift 2
  "$program" "$@" --out "$work/$name" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
  cp "$work/$name/$file" "$pictures/$name.svg"
}

# poster NAME SCENE LOOK [WIDTH HEIGHT]: the viewer at LOOK (viewer/README.md)
poster() {
  "$program" run "$2" --view --quiet --out "$work/$1"
  node viewer/poster.mjs "$work/$1/view.html" "$pictures/$1.png" "$3" "${4:-760}" "${5:-440}"
}

drawn arch limit.svg limit cases/arch/scene.toml
drawn gate limit.svg limit examples/gate.toml --load right
drawn joint_sets limit.svg limit examples/joint_sets.toml
drawn stereonet stereonet.svg slice docs/slicing.toml --report
drawn block_sizes block_sizes.svg slice docs/slicing.toml --report
drawn joint_laws joint_test.svg joint-test docs/joint_laws.toml --stress 1e6 --stress 2e6 --slip 5e-3 --steps 60
drawn tutorial_poles stereonet.svg slice examples/tutorial/slope.toml --report
poster slab docs/scenes.toml 'frame=9999&forces=arrows'
poster wedge examples/wedge.toml 'frame=9&magnified=10&colour=displacement&forces=arrows'
poster column docs/faces.toml 'frame=9999&magnified=300&colour=displacement&forces=arrows'
poster excavation docs/excavation.toml 'frame=9999&magnified=300&colour=displacement' 460 300
poster supports docs/supports.toml 'frame=9999&forces=network&forceSize=0.3' 460 330
poster wet_slope examples/wet_slope.toml 'frame=9999&colour=displacement&forces=arrows'
poster bolted_roof examples/bolted_roof.toml 'frame=9999&forces=arrows' 620 360
poster shaken_block examples/shaken_block.toml 'frame=9999&colour=displacement' 620 360
poster tutorial examples/tutorial/slope.toml 'frame=9999&magnified=10&colour=displacement&forces=arrows' 620 380
