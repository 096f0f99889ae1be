#!/usr/bin/env bash
# Installs the packages of packages.txt, or those named, that this machine lacks; silent when nothing is missing.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
mapfile -t wanted < <(grep -vE '^\s*(#|$)' "$here/packages.txt")
[ $# -eq 0 ] || wanted=("$@")
missing=()
for package in "${wanted[@]}"; do
  # Debian's npm cannot stand beside a node that came from elsewhere
  [ "$package" = npm ] && command -v npm >/dev/null && continue
  [ "$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null)" = "install ok installed" ] || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0
if [ "$(id -u)" -eq 0 ]; then as_root=(); else as_root=(sudo); fi
if [ ${#as_root[@]} -gt 0 ] && ! command -v sudo >/dev/null; then
  echo "missing packages: ${missing[*]}; install them as root, or install sudo" >&2
  exit 1
fi
echo "installing ${#missing[@]} Debian packages: ${missing[*]}"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! { "${as_root[@]}" apt-get update -q && "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
       apt-get install -y -q --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
  tail -n 20 "$log" >&2
  echo "installing the packages failed" >&2
  exit 1
fi
