#!/usr/bin/env bash
# build.sh FOLDER: compiles into FOLDER the adapters whose engines are installed, and installs the engines that run in Node. Prints a
# line for each engine; an engine that is missing is no error.
set -uo pipefail
here=$(cd "$(dirname "$0")" && pwd)
folder=$1
mkdir -p "$folder"
compiler=${CXX:-$(command -v clang++ || command -v g++)}

# compile NAME HEADER OPTIONS…: if the header is found
compile() {
  local name=$1 header=$2 source=$here/$1/$1.cpp
  shift 2
  if ! echo "#include <$header>" | "$compiler" -E -x c++ "$@" - >/dev/null 2>&1; then
    echo "$name: not installed"
    rm -f "$folder/$name"
  elif [ "$folder/$name" -nt "$source" ] && [ "$folder/$name" -nt "$here/scene.hpp" ]; then
    echo "$name: built"
  elif "$compiler" -std=gnu++20 -O2 -I"$here/../.." "$source" -o "$folder/$name" "$@" 2>"$folder/$name.log"; then
    echo "$name: built now"
  else
    echo "$name: does not compile, see $folder/$name.log"
  fi
}

# shellcheck disable=SC2046
compile bullet btBulletDynamicsCommon.h $(pkg-config --cflags --libs bullet-float64 2>/dev/null)
compile ode ode/ode.h -lode
compile box2d box2d/box2d.h -lbox2d
compile mujoco mujoco/mujoco.h -lmujoco

node_folder=$folder/node
if command -v node >/dev/null && command -v npm >/dev/null; then
  mkdir -p "$node_folder/rapier" "$node_folder/jolt"
  cp "$here/package.json" "$here/package-lock.json" "$here/scene.mjs" "$node_folder"
  cp "$here/rapier/rapier.mjs" "$node_folder/rapier"
  cp "$here/jolt/jolt.mjs" "$node_folder/jolt"
  if [ -d "$node_folder/node_modules/jolt-physics" ] ||
     (cd "$node_folder" && npm ci --ignore-scripts --no-audit --no-fund) >"$folder/npm.log" 2>&1; then
    echo "rapier, jolt: installed"
  else
    echo "rapier, jolt: 'npm ci' failed, see $folder/npm.log"
    rm -rf "$node_folder"
  fi
else
  echo "rapier, jolt: node or npm is not installed"
fi
