# shellcheck shell=bash
# Bash completion of domefall, which asks --help what there is.

# Sets verbs, options, arguments (what may stand for each) and takes (the same of each option) to those
# of a verb's --help.  What is right of column 30 explains.
_domefall_read() {
  local line section='' names type kind name
  verbs=() options=() arguments=() takes=()
  while IFS= read -r line; do
    [[ $line != [A-Z]*: ]] || section=$line
    [[ $line == '  '[!\ ]* ]] || continue
    [[ ${line:29:1} != ' ' ]] || line=${line:0:30}
    read -r names type _ <<<"$line"
    kind=
    case $type in
      *'{'*'},...') kind="list ${type//[^a-z0-9_,-]/ }" ;;
      *'{'*) type=${type#*\{} kind="words ${type%\}*}" ;;
      FILE*) [[ $names == SHOW ]] && kind='show' || kind='file' ;;
      FOLDER*) kind=folder ;;
      '' | *s:) ;;
      *) kind=other ;;
    esac
    kind=${kind//,/ }
    [[ -z $kind || $line != *' ...'* ]] || kind="many $kind"
    case $section in
      Subcommands:) verbs+=("$names") ;;
      Positionals:) arguments+=("$kind") ;;
      Options:)
        for name in ${names//,/ }; do
          [[ $name != --* ]] || options+=("$name")
          takes[$name]=$kind
        done
        ;;
    esac
  done < <("${COMP_WORDS[0]/#\~\//$HOME/}" "$@" --help 2>/dev/null)
}

# The words before the cursor decide what may stand there: the value of an option, an option, or an
# argument of the verb.
_domefall() {
  local current=${COMP_WORDS[COMP_CWORD]} word kind=''
  local -i k place=0 last
  local -a words=() verb=() verbs options arguments
  local -A takes
  COMPREPLY=()
  # Bash takes the = of --size=4k for a word.
  for ((k = 1; k < COMP_CWORD; k++)); do
    [[ ${COMP_WORDS[k]} == = ]] || words+=("${COMP_WORDS[k]}")
  done
  [[ $current != = ]] || current=''
  set -- "${words[@]}"
  _domefall_read
  # The verb may have two words.
  while (($#)) && [[ " ${verbs[*]} " == *" $1 "* ]]; do
    verb+=("$1")
    shift
    _domefall_read "${verb[@]}"
  done
  if ((${#verbs[@]})); then
    (($#)) || _domefall_complete "words ${verbs[*]} ${options[*]}"
    return
  fi
  for word; do
    if [[ $word == -* ]]; then
      kind=${takes[$word]:-}
    elif [[ -z $kind ]]; then
      place+=1
    elif [[ $kind != many* ]]; then
      kind=''
    fi
  done
  last=$((${#arguments[@]} - 1))
  if [[ $current == -* ]]; then
    kind="words ${options[*]}"
  elif [[ -z $kind ]] && ((place <= last)); then
    kind=${arguments[place]}
  elif [[ -z $kind ]] && ((last >= 0)) && [[ ${arguments[last]} == many* ]]; then
    kind=${arguments[last]}
  fi
  _domefall_complete "$kind"
}

# Fills COMPREPLY with what may stand at the cursor.
_domefall_complete() {
  local start name
  set -- "${1#many }"
  case $1 in
    show | file)
      compopt -o filenames 2>/dev/null
      while IFS= read -r name; do
        [[ -d $name || $1 == file || $name =~ \.ya?ml$ ]] && COMPREPLY+=("$name")
      done < <(compgen -f -- "${current/#\~\//$HOME/}")
      ;;
    folder)
      compopt -o filenames 2>/dev/null
      mapfile -t COMPREPLY < <(compgen -d -- "${current/#\~\//$HOME/}")
      ;;
    'list '*)
      compopt -o nospace 2>/dev/null
      start=${current%"${current##*,}"}
      mapfile -t COMPREPLY < <(compgen -P "$start" -W "${1#* }" -- "${current##*,}")
      ;;
    'words '*) mapfile -t COMPREPLY < <(compgen -W "${1#* }" -- "$current") ;;
  esac
}

complete -F _domefall domefall
