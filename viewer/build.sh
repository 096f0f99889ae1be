#!/usr/bin/env bash
# build.sh MODULES ASSET NODE: the bundle as ASSET, a C++ file; without modules or node, an empty file, and its tests are
# skipped by name.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
modules=$1 asset=$2 node=$3
mkdir -p "$(dirname "$asset")"
if [ -e "$modules/stamp" ] && [ -x "$node" ]; then
  NODE_PATH=$modules/node_modules exec "$node" "$here/build.mjs" "$modules" "$asset"
fi
cat "$modules/missing" 2>/dev/null || echo "node was not found when it was built: install npm and build again"
: >"$asset"
