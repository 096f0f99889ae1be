#!/usr/bin/env bash
# run_tests.sh BUILD JOBS [long]: runs every short test, then the verdict table, or with `long` the long tests; the last lines are
# CTest's summary and ours. With VOUSSOIR_NO_SKIP=1 a short skipped test counts as a failure, except those of allowed_skips.txt.
set -uo pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=$(cd "$1" && pwd) jobs=$2 kind=${3:-short}
started=$SECONDS
if [ "$kind" = long ]; then
  (cd "$build" && ctest -C Long -L long --output-on-failure --parallel "$jobs" --output-log ctest_long.log)
  status=$?
  took="$((SECONDS - started)) s, $("$here/seconds.sh" $SECONDS) with the build"
  if [ $status -eq 0 ]; then
    echo "make test-long: all long tests passed in $took; log: $1/ctest_long.log, checks: $1/verdicts-long"
  else
    echo "make test-long: FAILED after $took (see above and $1/ctest_long.log)"
  fi
  exit $status
fi
rm -rf "$build/reports/verdicts.txt" "$build/test_results"
[ "${VOUSSOIR_NO_SKIP:-}" != 1 ] || export GTEST_OUTPUT="xml:$build/test_results/"
# one more at a time than there are cores: several wait for disks, clocks and browsers
(cd "$build" && ctest --output-on-failure --parallel "$((jobs + 1))" --output-log ctest.log --output-junit test_results.xml)
status=$?
if [ "${VOUSSOIR_NO_SKIP:-}" = 1 ]; then
  skipped=$("$here/refused_skips.sh" "$build" "$here/allowed_skips.txt")
  [ -z "$skipped" ] || { status=1; echo "skipped, which VOUSSOIR_NO_SKIP forbids:" $skipped; }
fi
verdicts=$(cat "$build/reports/verdicts.txt" 2>/dev/null || echo "no verdict table")
took="$((SECONDS - started)) s, $("$here/seconds.sh" $SECONDS) with the build"
if [ $status -eq 0 ]; then
  echo "make test: all tests passed in $took; $verdicts: $1/reports/verdicts.md, log: $1/ctest.log"
else
  echo "make test: FAILED after $took (see above and $1/ctest.log); $verdicts"
fi
exit $status
