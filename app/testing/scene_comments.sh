#!/usr/bin/env bash
# scene_comments.sh PROGRAM SOURCE SCRATCH: runs the commands of the program in comments of the scenes and studies below cases
# and examples, in a copy of that folder. Of a study, whose runs would take long, the plan is made, which reads every scene
# with all its settings; a command without a scene is checked against its help. Fails if a command is refused or fails.
set -uo pipefail
program=$(realpath "$1") source=$(realpath "$2") scratch=$3
rm -rf "$scratch"
mkdir -p "$scratch/home"
cp -r "$source/cases" "$source/examples" "$scratch/home"
cd "$scratch/home" || exit 1

faults=0 count=0
fault() { echo "$1" >&2; faults=$((faults + 1)); }

# options that the command's help does not know
unknown_options() {
  local help=$("$program" "$1" --help 2>&1) option
  for option in "${@:2}"; do
    case $option in
      --*) grep -qw -- "${option%%=*}" <<<"$help" || echo "$option" ;;
    esac
  done
}

# in backquotes, or a comment of its own
commands_of() {
  sed -n 's/^[^#]*#//p' "$1" | { grep -o '`voussoir [^`]*`' || true; } | tr -d '`'
  sed -n 's/^# *\(voussoir [a-z].*\.toml.*\)$/\1/p' "$1"
}

while IFS= read -r file; do
  while IFS= read -r command; do
    count=$((count + 1))
    read -ra words <<<"${command#voussoir }"
    unknown=$(unknown_options "${words[@]}")
    if [ -n "$unknown" ]; then
      fault "$file: '$command': 'voussoir ${words[0]}' has no $unknown"
    elif [[ $command == *.toml* ]]; then
      # as written, from the repository's root or from the folder of the scene
      folder=. named=$(grep -o '[^ ]*\.toml' <<<"$command" | head -1)
      [ -e "$named" ] || folder=$(dirname "$file")
      [ "${words[0]}" = study ] && [[ ${words[1]} == *.toml ]] && words=(study plan "${words[@]:1}")
      [[ " ${words[*]} " == *" --out "* ]] || words+=(--out "$scratch/out_$count")
      output=$(cd "$folder" && "$program" "${words[@]}" 2>&1 </dev/null) || fault "$file: '$command' fails: $output"
    fi
  done < <(commands_of "$file" | sort -u)
done < <(find cases examples -name '*.toml' | sort)

[ $count -gt 0 ] || fault "no command in any comment"
exit $((faults > 0))
