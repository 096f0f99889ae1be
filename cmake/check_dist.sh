#!/usr/bin/env bash
# check_dist.sh FOLDER JOBS [CMAKE-OPTION…]: makes the source archive, unpacks it, and in a namespace without network builds and installs the
# program and the shared library, runs scenes, and builds a consumer of the library. Status 77 without unshare.
set -euo pipefail
folder=$(mkdir -p "$1" && cd "$1" && pwd) jobs=$2
shift 2
here=$(cd "$(dirname "$0")" && pwd)
without_network=(unshare --net)
[ "$(id -u)" = 0 ] || without_network=(unshare --net --map-root-user)
"${without_network[@]}" true 2>/dev/null || { echo "skipped: unshare makes no namespace without network here"; exit 77; }
# the namespace has no way out: its only device is down
"${without_network[@]}" sh -c '[ "$(ls /sys/class/net 2>/dev/null | grep -vc "^lo$")" = 0 ] || [ -z "$(cat /proc/net/route | tail -n +2)" ]'

"$here/make_dist.sh" "$folder"
archives=("$folder"/voussoir-*.tar.gz)
rm -rf "$folder/unpacked" "$folder/prefix" "$folder/work"
mkdir "$folder/unpacked"
tar -xzf "${archives[0]}" -C "$folder/unpacked" --strip-components=1
[ ! -e "$folder/unpacked/.git" ]

export here folder jobs
"${without_network[@]}" bash -euo pipefail -c '
  cd "$folder/unpacked"
  cmake --preset release -DVOUSSOIR_BUILD_TESTS=OFF -DVOUSSOIR_BUILD_BENCHMARKS=OFF -DVOUSSOIR_WITH_PYTHON=OFF -DVOUSSOIR_SHARED=ON "$@" \
        >../build.log 2>&1 && cmake --build build --parallel "$jobs" >>../build.log 2>&1 ||
    { tail -n 20 ../build.log; exit 1; }
  cmake --install build --prefix "$folder/prefix" >>../build.log
  "$folder/prefix/bin/voussoir" --version
  packaging/linked_libraries.py packaging/copyright "$folder/prefix/bin/voussoir"
  library/use_library.sh "$folder/prefix" "$folder/work" clang++ "$PWD/examples/library" \
                         "$PWD/app/testing/two_squares.toml" "$PWD/app/testing/two_cubes.toml"
' check "$@"
echo "make dist-check: ${archives[0]} builds and runs without network"
