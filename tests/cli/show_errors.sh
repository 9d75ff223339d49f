#!/usr/bin/env bash
# A broken show ends with 2, one that lacks only files with 75; what is wrong goes to stderr, each
# line with file:line:column, and nothing to stdout.
source "$(dirname "$0")/common.bash"

# broken NAME PLACES: the show on stdin is refused at these places, in this order, and at no other.
broken() {
  local name=$1
  shift
  cat >"$name"
  exits "${code:-2}" "$DOMEFALL" check "$name"
  [ ! -s stdout ] || fail "$name: talk on stdout"
  local told
  told=$(sed -E 's/^([^:]*:[0-9]+:[0-9]+): .+/\1/' stderr)
  [ "$told" = "$(printf "$name:%s\n" "$@")" ] || fail "$name: instead of $* came: $(cat stderr)"
}

broken fall.yaml 4:56 <<'END'
title: Fall
black_hole: {mass_solar: 4.3e6}
timeline:
  - {duration_s: 2, trajectory: {type: infall, from_r: -3}}
END
says 'fall.yaml:4:56: timeline\[1\]\.trajectory\.from_r must exceed 0 \(units of M\), got -3$'

broken keys.yaml 1:1 3:1 4:1 <<'END'
titel: Fall
timeline: [{duration_s: 2}]
timeline: []
camera:
END
says "did you mean title\?"

printf 'timeline: [{duration_s: 2}]\r\ntitle: caf\xe9\r\n' | broken latin.yaml 2:11
says 'not UTF-8'

# Another machine may have these.
code=75 broken files.yaml 2:30 3:17 <<'END'
timeline: [{duration_s: 2}]
sky: {region_I: {background: nowhere.exr}}
grade: {config: nowhere.ocio}
END

# What has no place within a file is told with the file alone.
exits 2 "$DOMEFALL" check .
says '^\.: this is a folder'
[ ! -s stdout ] || fail "a folder made talk on stdout"
