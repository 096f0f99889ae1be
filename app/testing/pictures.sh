#!/usr/bin/env bash
# pictures.sh PROGRAM SOURCE: holds docs/pictures.csv against the scenes as they are now, the pictures and the pages. Fails if the
# input hash of a scene is no longer that of its picture, if a page shows a picture without a row, if a row has no picture or no
# page shows it, and if a picture is too large. Runs no scene.
set -uo pipefail
program=$(realpath "$1")
cd "$2" || exit 1
largest=60000  # bytes
table=docs/pictures.csv maker=docs/make_pictures.sh
faults=0
fault() { echo "$1" >&2; faults=$((faults + 1)); }

now=$("$maker" "$program" --table) || { echo "$maker: no table of the scenes as they are now" >&2; exit 1; }
[ "$(head -n 1 $table)" = "$(head -n 1 <<<"$now")" ] || fault "$table: the first line must be '$(head -n 1 <<<"$now")'"
shown=$(grep -ohE 'pictures/[a-z0-9_]+\.(svg|png)' README.md docs/*.md examples/*.md examples/*/*.md | sed 's|.*/||' | sort -u)

while IFS=, read -r picture scene set hash; do
  again="make it again by '$maker PROGRAM ${picture%.*}'"
  row=$(grep "^$picture," $table) || { fault "$table: picture $picture has no row; $again"; continue; }
  [ "$row" = "$picture,$scene,$set,$hash" ] || fault "picture $picture shows scene $scene as it was; $again"
  [ -f "docs/pictures/$picture" ] || fault "$table: picture $picture does not exist; $again"
  grep -qx -- "$picture" <<<"$shown" || fault "picture $picture: no page shows it"
done < <(tail -n +2 <<<"$now")

listed=$(cut -d, -f1 $table | tail -n +2)
while read -r picture; do
  grep -q "^$picture," <<<"$now" || fault "$table: $maker does not make picture $picture"
done <<<"$listed"
while read -r picture; do
  grep -qx -- "$picture" <<<"$listed" || fault "picture $picture: a page shows it, but $table has no row for it"
done <<<"$shown"
for file in docs/pictures/*; do
  picture=$(basename "$file") size=$(stat -c %s "$file")
  grep -qx -- "$picture" <<<"$listed" || fault "$file: $table has no row for it"
  [ "$size" -le $largest ] || fault "$file: has $size bytes, at most $largest"
done
exit $((faults > 0))
