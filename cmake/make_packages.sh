#!/usr/bin/env bash
# make_packages.sh BUILD JOBS: Debian packages of the program, the library and the Python module in BUILD,
# and lintian's word on them; fails where lintian finds an error.
set -euo pipefail
build=$1 jobs=$2
source=$(cd "$(dirname "$0")/.." && pwd)
for tool in dpkg-shlibdeps file lintian; do
  command -v $tool >/dev/null || { echo "make_packages.sh: $tool is missing (Debian: dpkg-dev, file, lintian)" >&2; exit 2; }
done

# packages are dated by what they are made of
export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git -C "$source" log -1 --format=%ct 2>/dev/null || date +%s)}
umask 022
mkdir -p "$build"
rm -f "$build"/*.deb
cd "$source"
{
  cmake --preset packages -B "$build" ${DEBEMAIL:+-DVOUSSOIR_MAINTAINER="${DEBFULLNAME:-The Voussoir authors} <$DEBEMAIL>"}
  cmake --build "$build" --parallel "$jobs"
  (cd "$build" && cpack)
} >"$build/packages.log" 2>&1 || { tail -n 20 "$build/packages.log"; exit 1; }
lintian --fail-on error --info --tag-display-limit 0 "$build"/*.deb >"$build/lintian.log" 2>&1 ||
  { cat "$build/lintian.log"; exit 1; }
grep -E '^[EW]: ' "$build/lintian.log" || true
for package in "$build"/*.deb; do
  echo "$(basename "$package"): $(dpkg-deb -f "$package" Version), $(stat -c %s "$package") bytes"
done
