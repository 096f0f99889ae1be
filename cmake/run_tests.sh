#!/usr/bin/env bash
# Runs every short test, then the verdict table; the last lines are CTest's summary and ours. With VOUSSOIR_NO_SKIP=1 a
# skipped test counts as a failure, except those of allowed_skips.txt.
set -uo pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=$(cd "$1" && pwd) jobs=$2
started=$SECONDS
rm -rf "$build/reports/verdicts.txt" "$build/test_results"
[ "${VOUSSOIR_NO_SKIP:-}" != 1 ] || export GTEST_OUTPUT="xml:$build/test_results/"
(cd "$build" && ctest --output-on-failure --parallel "$jobs" --output-log ctest.log --output-junit test_results.xml)
status=$?
if [ "${VOUSSOIR_NO_SKIP:-}" = 1 ]; then
  skipped=$("$here/refused_skips.sh" "$build" "$here/allowed_skips.txt")
  [ -z "$skipped" ] || { status=1; echo "skipped, which VOUSSOIR_NO_SKIP forbids:" $skipped; }
fi
verdicts=$(cat "$build/reports/verdicts.txt" 2>/dev/null || echo "no verdict table")
if [ $status -eq 0 ]; then
  echo "make test: all tests passed in $((SECONDS - started)) s; $verdicts: $1/reports/verdicts.md," \
       "log: $1/ctest.log"
else
  echo "make test: FAILED (see above and $1/ctest.log); $verdicts"
fi
exit $status
