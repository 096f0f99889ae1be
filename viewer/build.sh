#!/usr/bin/env bash
# build.sh MODULES ASSET NODE: the bundle as ASSET, a C++ file; where MODULES has none, one that says why.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
modules=$1 asset=$2 node=$3
if [ -e "$modules/stamp" ] && [ -x "$node" ]; then
  NODE_PATH=$modules/node_modules exec "$node" "$here/build.mjs" "$modules" "$asset"
fi
missing=$(cat "$modules/missing" 2>/dev/null || echo "node was not found when it was built: install npm and build again")
cat >"$asset" <<END
#include "app/view/asset.hpp"

namespace voussoir::viewer {

const std::string_view missing = R"voussoir($missing)voussoir";
const std::string_view script, before_page, after_page, before_look, before_poster, before_data, after_fragment;

}  // namespace voussoir::viewer
END
