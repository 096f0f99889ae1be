#!/usr/bin/env bash
# Runs every short test, then the verdict table; the last lines are CTest's summary and ours.
set -uo pipefail
build=$1 jobs=$2
started=$SECONDS
rm -f "$build/reports/verdicts.txt"
(cd "$build" && ctest --output-on-failure --parallel "$jobs" --output-log ctest.log)
status=$?
verdicts=$(cat "$build/reports/verdicts.txt" 2>/dev/null || echo "no verdict table")
if [ $status -eq 0 ]; then
  echo "make test: all tests passed in $((SECONDS - started)) s; $verdicts: $build/reports/verdicts.md," \
       "log: $build/ctest.log"
else
  echo "make test: FAILED (see above and $build/ctest.log); $verdicts"
fi
exit $status
