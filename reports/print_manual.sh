#!/usr/bin/env bash
# print_manual.sh MANUAL.print.html OUT.pdf: prints the manual by headless Chromium, with outline and page numbers, with all folded
# parts open. Its list of contents has an empty <span data-page="ID"> for each page's number: a first print, whose drawings
# are empty, shows on which page each ID is, the second one has the numbers. Without Chromium or poppler-utils it prints a
# message and ends with 77.
set -uo pipefail
page=$(realpath "$1") out=$2
for tool in chromium pdfinfo; do
  if ! command -v $tool >/dev/null; then
    echo "SKIPPED: $tool is not installed, $(basename "$out") is not printed"
    exit 77
  fi
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
rm -f "$out"

# print PAGE PDF
print() {
  # as root, as in a container, Chromium has no sandbox; the page is ours and loads nothing
  timeout 1800 chromium --headless --no-sandbox --disable-gpu --user-data-dir="$work/profile" --no-pdf-header-footer \
    --generate-pdf-document-outline --print-to-pdf="$2" "file://$1" >"$work/log" 2>&1
  local status=$?
  if [ $status -ne 0 ] || [ ! -s "$2" ]; then
    tail -n 5 "$work/log"
    echo "$(basename "$out"): chromium ended with status $status"
    exit 1
  fi
}

# a number takes the width that the style keeps for it, so that no line moves
perl -0pe 's{(<svg[^>]*>).*?</svg>}{$1</svg>}gs' "$page" >"$work/first.html"
print "$work/first.html" "$work/first.pdf"
pdfinfo -dests "$work/first.pdf" >"$work/places" || exit 1
perl -0pe 'BEGIN { local $/ = "\n"; open my $places, "<", shift; while (<$places>) { $number{$2} = $1 if /^\s*(\d+).*"(.*)"/ } }
           s{<span data-page="([^"]*)"></span>}{<span data-page="$1">$number{$1}</span>}g' "$work/places" "$page" >"$work/second.html"
print "$work/second.html" "$out"
