#!/usr/bin/env bash
# Two containers with one host name and one folder: the numbers of their processes tell nothing, and none
# takes the other's files.  What a container that was killed has left is taken by its successor, which is
# process 1 again.
source "$(dirname "$0")/common.bash"
contained() { unshare --pid --fork --kill-child --mount-proc --uts "$@"; }
contained true 2>stderr || { echo "no namespaces here: $(cat stderr)"; exit 77; }

write_grid_show fall.yaml 512 9
temporaries() { find out -name '.*.tmp' | wc -l; }
exits 0 contained "$DOMEFALL" render fall.yaml --frames 0 --out out

# write_until_seen FRAMES COMMAND...: starts COMMAND and sends STOP or KILL, as $signal says, to all its
# processes as soon as a file is being made.  Fails where it ends before.
write_until_seen() {
  set -m
  "$@" 2>long &
  set +m
  writer=$!
  while [ "$(temporaries)" -eq 0 ]; do kill -0 "$writer" 2>/dev/null || return; done
  kill -s "$signal" -- "-$writer"
  [ "$(temporaries)" -gt 0 ]
}

# With a number beyond 60, which the other container has not: dead, to who goes by numbers.
signal=STOP met=0
for try in $(seq 1 20); do
  # shellcheck disable=SC2016  # the inner shell expands
  if write_until_seen contained sh -c 'for k in $(seq 60); do (:); done; "$@"; exit $?' sh \
    "$DOMEFALL" render fall.yaml --frames "$((2 * try))-$((2 * try + 1))" --out out; then
    exits 0 contained "$DOMEFALL" render fall.yaml --frames 0 --out out
    exits 0 "$DOMEFALL" render fall.yaml --frames 0 --out out
    met=$((met + 1))
  fi
  kill -CONT -- "-$writer" 2>/dev/null || true
  wait "$writer" || fail "run $try, broken by a namesake: $(cat long)"
  [ "$(temporaries)" -eq 0 ] || fail "temporaries were left"
  [ "$met" -lt 3 ] || break
done
[ "$met" -ge 3 ] || fail "met $met namesakes in the middle of a file, instead of 3"

signal=KILL
for try in $(seq 1 20); do
  if write_until_seen contained "$DOMEFALL" render fall.yaml --frames "$((50 + try))" --out out; then break; fi
  wait "$writer" || true
done
wait "$writer" || true
# The one that was waited for may be gone before the others, one of which holds the file.
while pgrep --pgroup "$writer" --runstates D,R,S,T >/dev/null; do sleep 0.01; done
[ "$(temporaries)" -gt 0 ] || fail "no kill came in the middle of a file"
exits 0 contained "$DOMEFALL" render fall.yaml --frames 0 --out out
[ "$(temporaries)" -eq 0 ] || fail "process 1 leaves what process 1 has left: $(ls -A out/*)"
