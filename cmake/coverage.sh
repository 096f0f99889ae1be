#!/usr/bin/env bash
# coverage.sh SOURCE BUILD JOBS: line coverage of the core's rooms by their unit tests; fails if one of the rooms that
# read input or decide contacts is below the least share.
set -euo pipefail
source=$1 build=$2 jobs=$3
rooms=(scene geometry contact joint_laws)
least=95  # % of lines
tests=(unit_blocks unit_law_and_motion unit_contact unit_scene)

cd "$source"
mkdir -p "$build"
cmake --preset coverage -B "$build" >"$build/configure.log" 2>&1 || { cat "$build/configure.log"; exit 1; }
cmake --build "$build" --parallel "$jobs" --target "${tests[@]}"
find "$build" -name '*.gcda' -delete
(cd "$build" && ctest --output-on-failure --parallel "$jobs" -R "^unit\\.(blocks|law_and_motion|contact|scene)$")

# tests do not count as covered code
common=(--exclude-directories '.*CompilerId.*' --root "$source" --object-directory "$build" --exclude '.*_test\.[ch]pp' --exclude 'core/testing/')
gcovr "${common[@]}" --filter 'core/' --print-summary | tee "$build/coverage.txt"
failed=0
for room in "${rooms[@]}"; do
  share=$(gcovr "${common[@]}" --filter "core/$room/" | awk '$1 == "TOTAL" {print $4}')
  echo "core/$room: ${share:-nothing measured} of the lines"
  [ "${share%\%}" -ge "$least" ] 2>/dev/null || { echo "core/$room is below $least %"; failed=1; }
done
took=$("$source/cmake/seconds.sh" $SECONDS)
if [ $failed -eq 0 ]; then
  echo "make coverage: $least % or more of the lines of ${rooms[*]} are covered; table: $build/coverage.txt; $took with the build"
else
  echo "make coverage: FAILED (see above); table: $build/coverage.txt; $took with the build"
fi
exit $failed
