#!/usr/bin/env bash
# make_reports.sh BUILD JOBS: runs the cases, draws the figures, runs the studies that have changed, builds the manual.
# All steps run even after a failure, so that the manual shows it; the status is then not zero.
set -uo pipefail
build=$(cd "$1" && pwd) jobs=$2 shown=$1
source=$(cd "$(dirname "$0")/.." && pwd)
program=$build/app/voussoir
reports=$build/reports
failures=()
# settle STATUS STEP: 77 is a step that lacks a tool and has reported it
settle() {
  [ "$1" -eq 0 ] || [ "$1" -eq 77 ] || failures+=("$2")
}

echo "cases and figures"
mkdir -p "$reports"
rm -f "$reports/verdicts.txt"
if ! (cd "$build" && ctest -L "case|report" --parallel "$jobs" --output-on-failure --no-tests=error \
                           --output-log reports.log); then
  failures+=("cases or figures (log: $shown/reports.log)")
fi

# a study keeps the runs whose scene and program did not change; a run that hangs is stopped, which its report lists
longest_run=600  # s; the longest takes about 15 on an idle core
shopt -s nullglob
for plan in "$source"/cases/*/study.toml; do
  name=$(basename "$(dirname "$plan")")
  out=$reports/studies/$name
  log=reports/studies/$name.log
  mkdir -p "$reports/studies"
  if [ ! -x "$program" ]; then
    failures+=("study of $name (the program voussoir is not built)")
    continue
  fi
  rm -f "$out/study.md" "$out/study.json" "$out/study.csv"
  if [ ! -x "$build/cases/case_$name" ]; then
    echo "study of $name: not run, its case is not built"
    continue
  fi
  (cd "$source" && "$program" study "cases/$name/study.toml" --out "$out" --jobs "$jobs" --time-limit $longest_run) \
      >"$build/$log" 2>&1
  status=$?
  # status 1 means that some settings failed: a finding of the study, which its report lists
  if [ $status -gt 1 ] || [ ! -s "$out/study.csv" ]; then
    tail -n 5 "$build/$log"
    failures+=("study of $name (log: $shown/$log)")
    continue
  fi
  echo "study of $name: $(sed -n 2p "$build/$log")"
  "$build/reports/voussoir_study_report" case --study "$out/study.csv" --reference "$build/cases/$name/reference.json" \
      --out "$out" --style "$source/reports" || failures+=("report on the study of $name")
done
# error budgets of scenes
for name in incline roofwedge wedge; do
  [ -x "$program" ] || continue
  (cd "$source" && "$program" run "cases/$name/scene.toml" --budget --quiet --overwrite --set output.frames=false \
                              --out "$reports/budgets/$name") || failures+=("error budget of $name")
done
for out in "$reports"/studies/*/; do
  [ -e "$source/cases/$(basename "$out")/study.toml" ] || rm -rf "$out"
done
if [ -d "$reports/studies" ]; then
  "$build/reports/voussoir_study_report" compare --studies "$reports/studies" \
      --cases "$build/cases" --budgets "$reports/budgets" --style "$source/reports" ||
      failures+=("comparison of the studies")
fi

# dimensioned sketches and interactive views of the cases' blocks
if [ -x "$program" ]; then
  "$source/reports/make_sketches.py" --source "$source" --build "$build" || failures+=("sketches of the cases")
fi
"$source/reports/make_views.py" --source "$source" --build "$build" --jobs "$jobs"
settle $? "views of the cases"

# the pictures of the pages; those that are committed stay as they are
if [ -x "$program" ]; then
  "$source/docs/make_pictures.sh" "$program" --into "$reports/pictures"
  settle $? "pictures of the pages"
fi

# all checks at a glance
rm -rf "$reports/checks"
if [ -s "$reports/verdicts.json" ]; then
  "$build/reports/voussoir_study_report" checks --verdicts "$reports/verdicts.json" --out "$reports/checks" \
      --style "$source/reports" || failures+=("checks at a glance")
fi

# the contact kernel is timed again if it or a peer's harness has changed; `make benchmark` times it at length
benchmarks=$reports/benchmarks
bench=$build/benchmarks/bench_contact
if [ ! -x "$bench" ]; then
  echo "contact kernel: not timed, Google Benchmark is not installed"
elif [ -s "$benchmarks/contact.csv" ] && [ "$(cat "$benchmarks/contact.key" 2>/dev/null)" = "$(sha256sum <"$bench")" ]; then
  echo "contact kernel: unchanged"
else
  echo "contact kernel: timing"
  mkdir -p "$benchmarks"
  if ! VOUSSOIR_BENCHMARK=quick "$source/cmake/run_benchmarks.sh" "$build" >"$benchmarks/quick.log" 2>&1; then
    tail -n 5 "$benchmarks/quick.log"
    failures+=("contact kernel (log: $shown/reports/benchmarks/quick.log)")
  fi
fi
for figure in contact_planes contact_vertices; do
  # a figure whose methods were not all built has no data
  [ -s "$benchmarks/$figure.csv" ] || continue
  (cd "$benchmarks" && "$source/reports/draw.sh" "$source/reports/$figure.gp" "$reports/figures/$figure.svg")
  settle $? "figure $figure"
done
for figure in rest_cost limit_cost; do
  (cd "$source/reports" && ./draw.sh $figure.gp "$reports/figures/$figure.svg")
  settle $? "figure $figure"
done

cases=$(cut -d, -f1 "$reports/history.csv" 2>/dev/null | tail -n +2 | awk '!seen[$0]++' | paste -sd '|')
if [ -n "$cases" ]; then
  "$source/reports/draw.sh" "$source/reports/history.gp" "$reports/figures/history.svg" "data=$reports/history.csv" \
      "cases=$cases"
  settle $? "figure history"
fi

echo "manual"
rm -f "$reports/scene_keys.md"
if [ -x "$program" ] && ! "$program" docs >"$reports/scene_keys.md"; then
  rm -f "$reports/scene_keys.md"
  failures+=("scene keys (voussoir docs)")
fi
"$source/library/header_pages.py" "$source" "$reports/library_headers.md" >/dev/null || failures+=("public headers (library/header_pages.py)")
rm -rf "$reports"/manual-*  # of another version
"$build/reports/voussoir_manual" --source "$source" --build "$build" || failures+=("manual")
for pages in "$reports"/manual-*/; do
  "$source/reports/check_drawings.py" "$pages" || failures+=("drawings of the manual")
done
largest_manual=15000000  # bytes: in an e-mail, whose encoding adds a third, 20 MB, which most let through
for page in "$reports"/manual-*.print.html; do
  file=${page%.print.html}.html
  [ "$(stat -c %s "$file")" -le $largest_manual ] || failures+=("size of the manual: $(stat -c %s "$file") bytes, at most $largest_manual")
  "$source/reports/print_manual.sh" "$page" "${page%.print.html}.pdf" &&
      "$source/reports/same_numbers.py" "$page" "${page%.print.html}.pdf"
  settle $? "printed manual"
  rm -f "$page"
done
manuals=("$reports"/manual-*/index.html)
manual=${manuals[0]+$shown/reports/$(basename "$(dirname "${manuals[0]}")")/index.html}

for failure in "${failures[@]}"; do
  echo "FAILED: $failure"
done
verdicts=$(cat "$reports/verdicts.txt" 2>/dev/null || echo "no verdicts")
if [ ${#failures[@]} -eq 0 ]; then
  echo "make reports: $verdicts; manual: $manual; $("$source/cmake/seconds.sh" $SECONDS) with the build"
else
  echo "make reports: FAILED (${#failures[@]} above); $verdicts; manual: ${manual:-none}; $("$source/cmake/seconds.sh" $SECONDS) with the build"
  exit 1
fi
