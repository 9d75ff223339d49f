# What the scripts share: a folder of their own, and checks that say what went wrong.
set -euo pipefail
: "${DOMEFALL:?the program under test}" "${DOMEFALL_SOURCE:?the source tree}"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

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

# A show of 60 frames, on which little is to be seen, for tests of what is written.
write_grid_show() {
  cat >"$1" <<END
frames_per_second: 12
size: 64
black_hole: {mass_solar: 4.3e6}
sky: {region_I: {background: grid, stars: none}}
timeline: [{duration_s: 5, trajectory: {type: infall, from_r: 6, to_r: 2.5}}]
END
}

# same_frames A B: both folders hold the same files with the same bytes.
# same_pixels FILE FILE, whatever else the files say.
same_pixels() { oiiotool "$1" "$2" --fail 0 --diff >/dev/null 2>&1; }
same_frames() { diff -r "$1" "$2" >/dev/null || fail "$1 and $2 differ: $(diff -rq "$1" "$2" | head -3)"; }
