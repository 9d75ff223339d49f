#!/usr/bin/env bash
# What the tests of `domefall farm submit` share; to be sourced after farm_test.bash.

# code_of LOG command...: runs it and prints its exit code.
code_of() {
  local log=$1 code=0
  shift
  "$@" >"$log" 2>&1 || code=$?
  echo "$code"
}
expect() { # expect CODE LOG command...
  local code
  code=$(code_of "${@:2}")
  [[ $code == "$1" ]] || {
    cat "$2" >&2
    fail "${*:3}: exit code $code, not $1"
  }
}
says() { grep -qF -e "$2" "$1" || { cat "$1" >&2; fail "$1 does not say: $2"; }; }
says_not() { ! grep -qF -e "$2" "$1" || { cat "$1" >&2; fail "$1 says: $2"; }; }

# The id of the only plan in a folder.
plan_in() {
  local id
  id=$(basename "$1"/farm/plan_*.json .json)
  echo "${id#plan_}"
}

# write_program NAME: ./NAME is like domefall, but each `render` that makes frames first does what
# standard input says, in bash. There `on RANGE` asks whether its frames are RANGE; `once WORD` is true
# once; `first RANGE PART` renders PART of its frames, RANGE; `wait_for FILE` waits until it is there,
# or ends with 143 by TERM. So what happens at which frame does not depend on how fast a machine is.
write_program() {
  {
    cat <<SCRIPT
#!/bin/bash
scratch=${scratch:?} domefall=$DOMEFALL
SCRIPT
    cat <<'SCRIPT'
on() { [[ " ${arguments[*]} " == *" --frames $1 "* ]]; }
once() { mkdir "$scratch/$1.once" 2>/dev/null; }
first() { "$domefall" "${arguments[@]/#$1/$2}" || exit; }
wait_for() {
  trap 'exit 143' TERM
  until [[ -e $scratch/$1 ]]; do sleep 0.05; done
  trap - TERM
}
arguments=("$@")
if [[ $1 == render && " $* " != *" --dry-run "* ]]; then
SCRIPT
    cat
    cat <<'SCRIPT'
fi
exec "$domefall" "$@"
SCRIPT
  } >"$1"
  chmod +x "$1"
}
