#!/usr/bin/env bash
# run.sh PROGRAM TARGET replay|long [WORK DICTIONARY]: the committed corpus and, for scenes, the cases' own. `replay` runs each input once,
# by a program made from replay.cpp; `long` fuzzes from them for VOUSSOIR_FUZZ_SECONDS (3600) in the folder WORK, where it leaves its
# results: corpus/, and findings/ for inputs that break something.
set -euo pipefail
program=$1 target=$2 length=$3 work=${4:-} dictionary=${5:-}
here=$(cd "$(dirname "$0")" && pwd)
if [ ! -x "$program" ]; then
  echo "skipped: $program was not built (Debian: clang libclang-rt-14-dev)"
  exit 77
fi

seeds=()
if [ "$target" = scene ]; then
  mapfile -t seeds < <(find "$here/../cases" "$here/../app/testing" -name '*.toml' ! -name study.toml | sort)
fi
if [ "$length" = replay ]; then
  mapfile -t corpus < <(find "$here/corpus/$target" -type f | sort)
  exec "$program" "${corpus[@]}" "${seeds[@]}"
fi

# a finding must not be taken for a skip, whose code is libFuzzer's own for a crash
options=(-error_exitcode=1 -timeout=20 -rss_limit_mb=2048 -verbosity=0 -print_final_stats=1)  # a hang of one second ends the target itself
case $target in
  scene) options+=(-dict="$dictionary" -seed_inputs="$(IFS=,; echo "${seeds[*]}")" -max_len=6000) ;;
  import) options+=(-max_len=6000) ;;
  *) options+=(-max_len=120) ;;
esac
mkdir -p "$work/corpus/$target" "$work/findings"
exec "$program" "${options[@]}" -max_total_time="${VOUSSOIR_FUZZ_SECONDS:-3600}" -artifact_prefix="$work/findings/$target-" \
  "$work/corpus/$target" "$here/corpus/$target"
