#!/usr/bin/env bash
# installed_library.sh BUILD SCRATCH COMPILER [long]: installs into a scratch prefix, runs scenes with the installed program, checks the
# headers, and builds programs against the installed library, with AVX2: by CMake, and by pkg-config beside another library. Scenes
# end in the bits of the program. long: every header alone, every program with plain flags, too.
set -euo pipefail
build=$1 scratch=$2 compiler=$3 kind=${4:-}
root=$(cd "$(dirname "$0")/.." && pwd)
scenes="$root/app/testing/two_squares.toml $root/app/testing/two_cubes.toml"
rm -rf "$scratch"
cmake --install "$build" --prefix "$scratch/prefix" >/dev/null
# shellcheck disable=SC2086
WITH_PLAIN_FLAGS=$kind "$(dirname "$0")/use_library.sh" "$scratch/prefix" "$scratch/work" "$compiler" "$root/examples/library" $scenes
/usr/bin/env python3 "$(dirname "$0")/headers_alone.py" "$scratch/prefix/include" "$compiler" $kind

cd "$scratch/work"
plain=-O2 wide=
if grep -qw avx2 /proc/cpuinfo && grep -qw fma /proc/cpuinfo; then wide=-O2,-mavx2,-mfma; fi
library() { PKG_CONFIG_PATH=$(dirname "$(find "$scratch/prefix" -name voussoir.pc)") pkg-config "$@" voussoir; }
# a public header has no Eigen that a compiler's flags align, and the interface sets no macro of Eigen
if library --cflags | grep EIGEN; then exit 1; fi

# Together with another library, of other flags: its vectors arrive, and scenes end in the bits of the program. The wider
# registers align what the narrower ones do, and more: the plain flags besides only in the long test.
beside=$root/app/testing/beside_another_library
for machine in ${wide:-$plain} ${kind:+$plain}; do
  "$compiler" -std=c++20 ${machine//,/ } -I"$root" $(pkg-config --cflags eigen3) -c "$beside/other.cpp" -o other.o
  "$compiler" -std=c++20 ${machine//,/ } -iquote "$root" $(library --cflags) "$beside/main.cpp" other.o $(library --libs) \
              -Wl,-rpath,"$scratch/prefix/lib" -o beside
  # shellcheck disable=SC2086
  ./beside $scenes >beside.txt || { cat beside.txt; exit 1; }
  cmp bits.txt beside.txt
done
[ -n "$kind" ] || exit 0

# without a scene, and by headers that are not stable
cmake -S "$root/examples/sliding_block" -B sliding -DCMAKE_PREFIX_PATH="$scratch/prefix" -DCMAKE_CXX_COMPILER="$compiler" \
      -DCMAKE_BUILD_TYPE=Release >/dev/null
cmake --build sliding >/dev/null
sliding/sliding_block | tee sliding.txt
"$compiler" -std=c++20 -O2 -march=native "$root/examples/sliding_block/main.cpp" $(library --cflags --libs) \
            -Wl,-rpath,"$scratch/prefix/lib" -o sliding_native
./sliding_native | tee sliding_native.txt
cmp sliding.txt sliding_native.txt
