#!/usr/bin/env bash
# print_manual.sh MANUAL.html OUT.pdf: prints the manual by headless Chromium, with outline, contents and page numbers, with all
# folded parts open. Without Chromium it prints a message and ends with 77.
set -uo pipefail
page=$(realpath "$1") out=$2
if ! command -v chromium >/dev/null; then
  echo "SKIPPED: chromium is not installed, $(basename "$out") is not printed"
  exit 77
fi
profile=$(mktemp -d)
trap 'rm -rf "$profile"' EXIT
rm -f "$out"
# as root, as in a container, Chromium has no sandbox; the page is ours and loads nothing
timeout 240 chromium --headless --no-sandbox --disable-gpu --user-data-dir="$profile" --no-pdf-header-footer \
  --generate-pdf-document-outline --print-to-pdf="$out" "file://$page" >"$profile/log" 2>&1
status=$?
if [ $status -ne 0 ] || [ ! -s "$out" ]; then
  tail -n 5 "$profile/log"
  echo "$(basename "$out"): chromium ended with status $status"
  exit 1
fi
