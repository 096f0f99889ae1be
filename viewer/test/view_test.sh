#!/usr/bin/env bash
# view_test.sh NODE …: view_test.mjs where there is a node to run it.
node=$1
shift
if [ ! -x "$node" ]; then
  echo "not tested: node is not installed (npm brings it)"
  [ "${VOUSSOIR_NO_SKIP:-}" = 1 ] && exit 1
  exit 77
fi
exec "$node" "$(dirname "$0")/view_test.mjs" "$@"
