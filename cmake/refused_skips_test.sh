#!/usr/bin/env bash
# refused_skips_test.sh PROGRAM FOLDER: a test run of three tests: one passes, one is skipped by its exit code, and one, of
# the GoogleTest program PROGRAM, skips itself, since it finds no other program.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
program=$1 folder=$2
unset GTEST_OUTPUT VOUSSOIR_NO_SKIP
rm -rf "$folder"
mkdir -p "$folder"
cat >"$folder/CTestTestfile.cmake" <<C
add_test(passes "true")
add_test(skips "sh" "-c" "exit 77")
set_tests_properties(skips PROPERTIES SKIP_RETURN_CODE 77)
add_test(from_within "/usr/bin/env" "PATH=/nonexistent" "$program" "--gtest_brief=1" "--gtest_filter=ClusterExamples.*")
C
fail() {
  echo "$1"
  exit 1
}

"$here/run_tests.sh" "$folder" 1 >"$folder/said" 2>&1 || fail "a skip alone failed: $(cat "$folder/said")"
! VOUSSOIR_NO_SKIP=1 "$here/run_tests.sh" "$folder" 1 >"$folder/said" 2>&1 || fail "VOUSSOIR_NO_SKIP=1 changed nothing"
wanted="ClusterExamples.GnuParallelGivesTheSameFile skips"
grep -qx "skipped, which VOUSSOIR_NO_SKIP forbids: $wanted" "$folder/said" || fail "not named: $(cat "$folder/said")"

printf '# allowed\nskips  because\n' >"$folder/list"
found=$(echo $("$here/refused_skips.sh" "$folder" "$folder/list"))
[ "$found" = "${wanted% *}" ] || fail "refused though allowed, or the reverse: $found"
printf '%s\tbecause\n' $wanted >"$folder/list"
[ -z "$("$here/refused_skips.sh" "$folder" "$folder/list")" ] || fail "refused though all are allowed"
