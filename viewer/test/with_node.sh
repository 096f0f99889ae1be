#!/usr/bin/env bash
# with_node.sh NODE TEST …: runs TEST, a file in this folder, if there is a node to run it.
node=$1 test=$2
shift 2
if [ ! -x "$node" ]; then
  echo "not tested: node is not installed (npm brings it)"
  [ "${VOUSSOIR_NO_SKIP:-}" = 1 ] && exit 1
  exit 77
fi
exec "$node" "$(dirname "$0")/$test" "$@"
