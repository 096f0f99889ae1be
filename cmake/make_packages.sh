#!/usr/bin/env bash
# make_packages.sh BUILD JOBS: Debian packages of the program, the library and the Python module in BUILD,
# with lintian's report on them; fails if lintian finds an error.
set -euo pipefail
build=$1 jobs=$2
source=$(cd "$(dirname "$0")/.." && pwd)
for tool in dpkg-shlibdeps file lintian; do
  command -v $tool >/dev/null || { echo "make_packages.sh: $tool is missing (Debian: dpkg-dev, file, lintian)" >&2; exit 2; }
done

# packages have the date of their commit
export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git -C "$source" log -1 --format=%ct 2>/dev/null || date +%s)}
umask 022
mkdir -p "$build"
rm -f "$build"/*.deb
cd "$source"
{
  cmake --preset packages -B "$build" ${DEBEMAIL:+-DVOUSSOIR_MAINTAINER="${DEBFULLNAME:-The Voussoir authors} <$DEBEMAIL>"} &&
    cmake --build "$build" --parallel "$jobs" &&
    (cd "$build" && cpack)
} >"$build/packages.log" 2>&1 || { tail -n 20 "$build/packages.log"; exit 1; }
lintian --fail-on error --info --tag-display-limit 0 "$build"/*.deb >"$build/lintian.log" 2>&1 ||
  { cat "$build/lintian.log"; exit 1; }
grep -E '^[EW]: ' "$build/lintian.log" || true
for package in "$build"/*.deb; do
  echo "$(basename "$package"): $(dpkg-deb -f "$package" Version), $(stat -c %s "$package") bytes"
done
packages=("$build"/*.deb)
echo "make deb: ${#packages[@]} packages: $build/*.deb, lintian's report: $build/lintian.log; $("$source/cmake/seconds.sh" $SECONDS)"
