#!/usr/bin/env bash
# What the tests of the launchers share; to be sourced. A test runs in a scratch folder of its own,
# $scratch, which goes away when it ends, and finds a show there, fall.yaml.
# shellcheck source=../cli/common.bash
source "$(dirname "${BASH_SOURCE[0]}")/../cli/common.bash"
export DOMEFALL
scratch=$folder
trap 'end_marked; rm -rf "$scratch"' EXIT
# Processes that this test started, and theirs, are known by this mark in their environment.
export DOMEFALL_FARM_TEST=$scratch

pass() { printf 'ok (%2d s): %s\n' "$SECONDS" "$*"; }

# try_claims CLAIM...: runs these functions in their order.
try_claims() {
  local claim
  for claim in "$@"; do
    $claim
    pass "$claim"
  done
}
# The same of all functions that the test writes over several lines, but for what it begins before.
try_all_claims() {
  local claims
  mapfile -t claims < <(sed -n '/^begin_/d; s/^\([a-z_0-9]*\)() {$/\1/p' "$here/${0##*/}")
  try_claims "${claims[@]}"
}

# until_ok SECONDS command...: polls until the command succeeds.
until_ok() {
  local end=$((SECONDS + $1))
  shift
  until "$@" >/dev/null 2>&1; do
    ((SECONDS < end)) || return 1
    sleep 0.05
  done
}

# The processes that bear this test's mark, but for the shell that asks. slurmstepd writes its title
# over its environment; it is known by its folder.
marked() {
  local file pid
  # Processes come and go meanwhile, and those of other users cannot be read.
  {
    grep -lzxF "DOMEFALL_FARM_TEST=$scratch" /proc/[0-9]*/environ
    find /proc/[0-9]*/cwd -maxdepth 0 -lname "$scratch*" | while read -r file; do
      ! grep -qx slurmstepd "${file%cwd}comm" || echo "$file"
    done
  } 2>/dev/null | while read -r file; do
    pid=${file#/proc/} pid=${pid%/*}
    [[ $pid == "$$" || $pid == "$BASHPID" || ! -e /proc/$pid/exe ]] || echo "$pid"
  done
}

# The processes `domefall render` of this test, and those in their place, one a line.
workers() {
  local pid
  for pid in $(marked); do
    grep -qzxF render "/proc/$pid/cmdline" || continue
    echo "$pid"
  done 2>/dev/null
}

# Ends what is left of this test's processes.
end_marked() {
  until_ok 10 killed_marked || printf 'still running: %s\n' "$(marked | paste -sd' ')" >&2
}
killed_marked() {
  local pids
  mapfile -t pids < <(marked)
  ((${#pids[@]} == 0)) || { kill -KILL "${pids[@]}" && false; }
}

# A fall through the horizon, of 40 frames: one region and both, stars and the Milky Way.
cat >fall.yaml <<'YAML'
title: A fall for the farm
frames_per_second: 10
size: 64
black_hole: {mass_solar: 4.3e6}
sky: {region_I: {stars: naked_eye}}
camera: {look_at: hole, elevation_deg: 45}
timeline:
  - {duration_s: 2, trajectory: {type: infall, from_r: 30, to_r: 4}}
  - {duration_s: 2, trajectory: {type: infall, from_r: 4, to_r: 0.5}}
YAML

# same_frames A B COUNT: B holds the first COUNT frames of A, byte by byte, linear and graded, and
# no other file, hidden ones not counted.
same_frames() {
  local kind frame name
  for kind in linear/exr graded/png; do
    for ((frame = 0; frame < $3; ++frame)); do
      name=${kind%/*}/fall_$(printf %05d "$frame").${kind#*/}
      cmp "$1/$name" "$2/$name" || return 1
    done
    [[ $(find "$2/${kind%/*}" -mindepth 1 ! -name '.*' | wc -l) == "$3" ]] || {
      ls -l "$2/${kind%/*}" >&2
      return 1
    }
  done
}

# What a killed worker leaves is removed by the next one, if the dead one's number is free by then:
# its parent, or process 1, has asked how it ended.
no_temporaries() { [[ -z $(find "$1" -name '.*') ]]; }

# A program like domefall, but no file that it writes may have more than 1 kB while FILE is not there:
# the disk seems full, and domefall exits with 75.
write_full_disk_program() {
  cat >"$1" <<SCRIPT
#!/bin/bash
[[ \$1 != render || -e $2 ]] || { trap '' XFSZ; ulimit -f 1; }
exec $DOMEFALL "\$@"
SCRIPT
  chmod +x "$1"
}

# Which files are there, by inode and time: a frame that is made again has another.
made() { find "$1" -name 'fall_*' -printf '%f %i %T@\n' 2>/dev/null | sort; }

# still_made LIST FOLDER: all files of a list of made's are there, and are the same.
still_made() { [[ -z $(comm -23 "$1" <(made "$2")) ]]; }

# How many linear frames are there.
frames_in() { find "$1/linear" -name 'fall_*.exr' 2>/dev/null | wc -l; }
at_least() { (($(frames_in "$1") >= $2)); }

# ---- what is submitted ----

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
scratch=$scratch domefall=$DOMEFALL
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
