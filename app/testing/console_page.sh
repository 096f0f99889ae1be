#!/usr/bin/env bash
# console_page.sh PROGRAM PAGE SCRATCH: runs the commands of a page's console blocks in a copy of its folder. Fails where a
# command fails, where a line that the page shows below it is not printed (in this order; … stands for lines left out), and
# where a scene or study of the folder is in none of the commands.
set -uo pipefail
program=$(realpath "$1") page=$(realpath "$2") scratch=$3
rm -rf "$scratch"
mkdir -p "$scratch"
cp -r "$(dirname "$page")/." "$scratch"
cd "$scratch" || exit 1
rm -rf results  # of those who ran them there
PATH=$(dirname "$program"):$PATH

faults=0 number=0 shown=0 next=0 commands="" printed=()
fault() { echo "$(basename "$page"):$1" >&2; faults=$((faults + 1)); }

# the line is printed by the last command, below what was found before
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
    '```') shown=0 && continue ;;
  esac
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
for scene in *.toml; do
  [[ " $commands" == *" $scene "* ]] || fault "1: no command reads $scene"
done
exit $((faults > 0))
