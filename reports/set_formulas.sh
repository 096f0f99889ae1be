#!/usr/bin/env bash
# set_formulas.sh: sets the formulas of equations.toml as MathML with pandoc, one line each, into equations.mathml. Run it after
# a formula was changed; nothing else needs pandoc. The TeX stays in each line's annotation, by which a test detects stale formulas.
set -euo pipefail
cd "$(dirname "$0")"
awk -F"'" '/^\[/ { gsub(/[][]/, ""); number = $0 } /^formula = / { printf "N%s $$%s$$\n\n", number, $2 }' equations.toml |
  pandoc --from markdown --to html --mathml --wrap=none |
  sed -n 's|^<p>N\([^ ]*\) <math display="block" xmlns="[^"]*">\(.*\)</math></p>$|\1 <math displaystyle="true">\2</math>|p' >equations.mathml
count=$(grep -c '^\[' equations.toml)
if [ "$(wc -l <equations.mathml)" -ne "$count" ]; then
  echo "set_formulas.sh: $(wc -l <equations.mathml) of $count formulas were set" >&2
  exit 1
fi
