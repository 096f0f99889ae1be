#!/usr/bin/env bash
# console_page.sh PROGRAM PAGE SCRATCH [ROOT]: runs the commands of a page's console blocks in a copy of its folder, or, if ROOT
# is stated, in a folder that mirrors the repository ROOT. Fails if a command fails, if a line that the page shows below it is
# not printed (in this order; … means lines left out), and if a scene or study of the folder is in none of the commands
# (ROOT: a scene or study next to the page that begins with the page's name). With ROOT a block of toml whose first line is the
# name of a file, `# docs/scenes.toml`, must show lines of that file, in this order.
set -uo pipefail
program=$(realpath "$1") page=$(realpath "$2") scratch=$3 root=${4:+$(realpath "$4")}
rm -rf "$scratch"
mkdir -p "$scratch"
if [ -n "$root" ]; then
  for entry in "$root"/*; do
    case $(basename "$entry") in
      build* | results) ;;
      docs | examples) cp -r "$entry" "$scratch" ;;
      *) ln -s "$entry" "$scratch" ;;
    esac
  done
else
  cp -r "$(dirname "$page")/." "$scratch"
fi
cd "$scratch" || exit 1
rm -rf results  # of earlier runs
# make run, make run SCENE=…: the program is built
make() { "$root/cmake/run_scene.sh" "$(dirname "$(dirname "$program")")" "$(sed s/^SCENE=// <<<"${2:-}")" ""; }
PATH=$(dirname "$program"):$PATH

faults=0 number=0 shown=0 next=0 commands="" printed=()
fault() { echo "$(basename "$page"):$1" >&2; faults=$((faults + 1)); }

# the line is printed by the last command, below the lines found before
is_printed() {
  local i
  for ((i = next; i < ${#printed[@]}; i++)); do
    if [ "${printed[i]}" = "$1" ]; then
      next=$((i + 1))
      return 0
    fi
  done
  return 1
}

while IFS= read -r line; do
  number=$((number + 1))
  case $line in
    '```console') shown=1 && continue ;;
    '```toml') shown=2 && continue ;;
    '```') shown=0 && continue ;;
  esac
  if [ $shown = 2 ]; then
    shown=0
    [ -n "$root" ] && [ -f "${line#\# }" ] || continue
    command=${line#\# } output="" next=0 shown=3
    mapfile -t printed <"$command"
    continue
  elif [ $shown = 3 ]; then
    [ "$line" = … ] || is_printed "$line" || fault "$number: '$command' does not contain '$line' here"
    continue
  fi
  [ $shown = 1 ] || continue
  if [[ $line == '$ '* ]]; then
    command=${line#\$ }
    commands+="$command "
    output=$(eval "$command" 2>&1 </dev/null) || fault "$number: exit code $? of '$command': $output"
    mapfile -t printed <<<"$output"
    next=0
  elif [ "$line" != … ]; then
    is_printed "$line" || fault "$number: '$command' does not print '$line' here, but: $output"
  fi
done <"$page"

[ -n "$commands" ] || fault "1: no command in it"
if [ -n "$root" ]; then
  shopt -s nullglob
  scenes=(docs/"$(basename "$page" .md)"*.toml)
else
  scenes=(*.toml)
fi
for scene in "${scenes[@]}"; do
  [[ " $commands" == *" $scene "* ]] || fault "1: no command reads $scene"
done
exit $((faults > 0))
