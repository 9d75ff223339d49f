# What the scripts share: a folder of their own, in which they run, and checks that say what went wrong.
set -euo pipefail
: "${DOMEFALL:?the program under test}" "${DOMEFALL_SOURCE:?the source tree}"
# shellcheck disable=SC2034 # for what lies beside a script
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

fail() {
  printf 'FAILED: %s\n' "$*" >&2
  exit 1
}

# exits CODE COMMAND...: the command ends with that code; its output is kept in $folder/stdout and
# $folder/stderr.
exits() {
  local wanted=$1 code=0
  shift
  "$@" >"$folder/stdout" 2>"$folder/stderr" || code=$?
  [ "$code" -eq "$wanted" ] || {
    cat "$folder/stderr" >&2
    fail "exit code $code instead of $wanted: $*"
  }
}

# says PATTERN: what the last command wrote to stderr matches.
says() { grep -qE -- "$1" "$folder/stderr" || { cat "$folder/stderr" >&2; fail "no '$1'"; }; }

# A show of 24 small frames that falls through the horizon, without and with stars.
write_show() {
  cat >"$1" <<END
title: A short fall
frames_per_second: 12
size: 96
black_hole: {mass_solar: 4.3e6}
sky: {region_I: {stars: naked_eye}}
timeline:
  - {duration_s: 1, trajectory: {type: infall, from_r: 6, to_r: 2.5}}
  - {duration_s: 1, trajectory: {type: infall, from_r: 2.5, to_r: 1}}
END
}

# ended CODE PROCESS: what was started in the background ends with that code.
ended() {
  local code=0
  wait "$2" 2>/dev/null || code=$?
  [ "$code" -eq "$1" ] || fail "exit code $code instead of $1: $(cat stderr)"
}

# tells PATTERN: what the last command wrote to stdout matches.
tells() { grep -qE -- "$1" "$folder/stdout" || { cat "$folder/stdout" >&2; fail "no '$1'"; }; }

# write_grid_show FILE [SIZE SECONDS RATE]: a show on which little is to be seen, for tests of what is written.
write_grid_show() {
  cat >"$1" <<END
frames_per_second: ${4:-12}
size: ${2:-64}
black_hole: {mass_solar: 4.3e6}
sky: {region_I: {background: grid, stars: none}}
timeline: [{duration_s: ${3:-5}, trajectory: {type: infall, from_r: 6, to_r: 2.5}}]
END
}

# write_flat_show FILE SIZE SECONDS: a show without a hole, 4 graded frames a second, for tests of what
# becomes of frames.
write_flat_show() {
  cat >"$1" <<END
title: A short fall
frames_per_second: 4
size: $2
sky: {region_I: {background: grid, stars: none}}
output: {linear: none}
timeline: [{duration_s: $3}]
END
}

# same_pixels FILE FILE, whatever else the files say.
same_pixels() { oiiotool "$1" "$2" --fail 0 --diff >/dev/null 2>&1; }
# same_frames A B: both folders hold the same files with the same bytes.
same_frames() { diff -r "$1" "$2" >/dev/null || fail "$1 and $2 differ: $(diff -rq "$1" "$2" | head -3)"; }
