#!/usr/bin/env bash
# private_symbols.sh ARCHIVE, with GNU's binutils: makes the Eigen instantiations in the objects of an installed library local.
# Inline functions have the same names in a user's program, in which other flags may have vectorised or fused them, and the
# linker keeps one copy for all: it would change the results of the library, or of the program.
set -euo pipefail
archive=$(realpath "$1")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
number=0
ar t "$archive" | sort | uniq -c >members
while read -r copies name; do
  for ((copy = 1; copy <= copies; copy++)); do
    ar xN "$copy" "$archive" "$name"
    number=$((number + 1))
    # groups of which the linker keeps one become ordinary sections
    ld.bfd -r --force-group-allocation "$name" -o whole.o
    nm whole.o | sed -n 's/.* u //p' >shared  # variables of inline functions, one for all
    if [ -s shared ]; then objcopy --weaken-symbols=shared whole.o; fi
    objcopy --wildcard --localize-symbol='_ZN5Eigen*' --localize-symbol='_ZN[KRVO]5Eigen*' whole.o "$number-$name.o"
    rm -f "$name" whole.o shared
  done
done <members
rm members
rm -f "$archive"
ar qcs "$archive" ./*.o
