#!/usr/bin/env bash
# refused_skips.sh BUILD LIST: the tests that were skipped in the last run of run_tests.sh and that LIST does not allow,
# whole programs by CTest's report, single tests by those of GoogleTest; a name a line.
set -u
build=$1 list=$2
{
  grep -B1 '<skipped message="SKIP_RETURN_CODE' "$build/test_results.xml" | sed -nE 's/.*<testcase name="([^"]*)".*/\1/p'
  sed -nE 's/.*<testcase name="([^"]*)".* result="skipped".* classname="([^"]*)".*/\2.\1/p' "$build"/test_results/*.xml
} 2>/dev/null | sort -u | grep -vxFf <(sed -E 's/#.*//; s/[[:space:]].*//; /^$/d' "$list")
exit 0
