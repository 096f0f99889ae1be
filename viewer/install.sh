#!/usr/bin/env bash
# install.sh FOLDER NPM: installs the packages of package-lock.json into FOLDER; FOLDER/stamp marks success, otherwise
# FOLDER/missing has the reason. Never fails: the viewer is optional.
set -uo pipefail
here=$(cd "$(dirname "$0")" && pwd)
folder=$1 npm=$2
mkdir -p "$folder"
rm -f "$folder/stamp" "$folder/missing"
if [ ! -x "$npm" ]; then
  echo "npm was not found when it was built: install npm and build again" >"$folder/missing"
  exit 0
fi
cp "$here/package.json" "$here/package-lock.json" "$folder"
if (cd "$folder" && "$npm" ci --ignore-scripts --no-audit --no-fund) >"$folder/npm.log" 2>&1; then
  touch "$folder/stamp"
else
  echo "'npm ci' failed when it was built: see viewer/modules/npm.log in the build folder, and build again" >"$folder/missing"
fi
