#!/usr/bin/env bash
# install_packages.sh PURPOSE…: installs the packages of packages.txt for these purposes that this machine lacks, and prints
# them and their size before; silent if nothing is missing.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
missing=()
for purpose in "$@"; do
  mapfile -t wanted < <(awk -v head="[$purpose]" '/^\[/ {in_it = $0 == head; next} in_it && NF && !/^#/' "$here/packages.txt")
  [ ${#wanted[@]} -gt 0 ] || { echo "install_packages.sh: packages.txt has no [$purpose]" >&2; exit 2; }
  for package in "${wanted[@]}"; do
    # Debian's npm cannot be installed together with a node from another source
    [ "$package" = npm ] && command -v npm >/dev/null && continue
    [ "$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null)" = "install ok installed" ] || missing+=("$package")
  done
done
[ ${#missing[@]} -eq 0 ] && exit 0
if [ "$(id -u)" -eq 0 ]; then as_root=(); else as_root=(sudo); fi
if [ ${#as_root[@]} -gt 0 ] && ! command -v sudo >/dev/null; then
  echo "missing packages: ${missing[*]}; install them as root, or install sudo" >&2
  exit 1
fi
log=$(mktemp)
trap 'rm -f "$log"' EXIT
failed() {
  tail -n 20 "$log" >&2
  echo "installing the packages failed" >&2
  exit 1
}
install=(apt-get install -q --no-install-recommends)
"${as_root[@]}" apt-get update -q >"$log" 2>&1 || failed
# "Need to get 12.3 MB of archives. After this operation, 45.6 MB of additional disk space will be used."
size=$(LC_ALL=C "${install[@]}" --assume-no "${missing[@]}" 2>/dev/null |
  sed -nE 's/^Need to get ([^/]*[kMG]?B)(\/.*)? of archives\.$/\1 to download/p; s/^After this operation, (.*B) of additional disk space.*$/\1 on the disk/p' | paste -sd, - || true)
echo "installing ${#missing[@]} Debian packages for: $*${size:+ (${size//,/, }, with what they need)}: ${missing[*]}"
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive "${install[@]}" -y "${missing[@]}" >"$log" 2>&1 || failed
