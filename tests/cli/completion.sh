#!/usr/bin/env bash
# Bash completes verbs, options, the words that a value may be, shows, files and folders.
source "$(dirname "$0")/common.bash"
export LC_ALL=C  # the order of letters
# shellcheck source=/dev/null
source "$DOMEFALL_SOURCE/pipeline/program/install/domefall.bash"
PATH=$(dirname "$DOMEFALL"):$PATH
complete -p domefall | grep -q -- '-F _domefall domefall' || fail "nothing completes domefall"
mkdir -p frames "my shows"
touch fall.yaml flyby.yml notes.txt "my shows/far.yaml" mix.wav

# completes LINE: what bash offers at the line's end, one a line; the = of an option is a word to it.
completes() {
  local line=${1//=/ = }
  read -ra COMP_WORDS <<<"$line"
  [[ $line != *' ' ]] || COMP_WORDS+=('')
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
  _domefall 2>/dev/null || true
  ((${#COMPREPLY[@]} == 0)) || printf '%s\n' "${COMPREPLY[@]}" | sort
}
# offers LINE WORD...: just these, in the order of their letters.
offers() {
  local line=$1 found wanted
  shift
  found=$(completes "$line")
  wanted=$(printf '%s\n' "$@")
  [ "$found" = "$wanted" ] || fail "'$line' offers: ${found//$'\n'/, }; not: ${wanted//$'\n'/, }"
}

offers 'domefall st' stars states
offers 'domefall --v' --version
offers 'domefall sky i' import info
offers 'domefall nonsense ' ''
offers 'domefall render --f' --frames
offers 'domefall sky import --ra' --ra-left --ra-right
offers 'domefall movie fall.yaml --preset dome' dome dome8k
offers 'domefall movie fall.yaml --preset=h' hap
offers 'domefall render --overlay s' safe_area silhouette star_names sweet_spot
offers 'domefall render --overlay rim,sa' rim,safe_area
offers 'domefall deliver --depth ' 16 8
offers 'domefall sky import --projection h' healpix
offers 'domefall trace --method rk' rk4 rkf78
offers 'domefall render f' fall.yaml flyby.yml frames
offers 'domefall check ' fall.yaml flyby.yml frames 'my shows'
offers 'domefall check fall.yaml ' ''
offers 'domefall render --size 4k --dry-run fl' flyby.yml
offers 'domefall render fall.yaml --frames ' ''
offers 'domefall render fall.yaml --out f' frames
offers 'domefall movie fall.yaml --audio m' mix.wav 'my shows'
offers 'domefall movie fall.yaml --audio mix.wav n' notes.txt
offers 'domefall stars import au' auto
offers 'domefall stars import auto notes.txt m' mix.wav 'my shows'

# Every option of every verb's --help is offered.
for verb in check render grade preview movie deliver sheet timeline states probe trace report \
  'stars import' 'stars info' 'sky import' 'sky build' 'sky check' 'sky info'; do
  # shellcheck disable=SC2086
  "$DOMEFALL" $verb --help | sed -n '/^Options/,/^$/p' | grep -oE -- '^  (-h,)?--[a-z-]+(,--[a-z-]+)*' |
    grep -oE -- '--[a-z-]+' | sort >options
  completes "domefall $verb --" | diff options - || fail "$verb: not the options of --help"
done
