#!/usr/bin/env bash
# Two processes make the same frames in one folder at once, and one is frozen in the middle of a file until the
# other is done: nobody removes the frozen one's file, and every frame has the bytes of a single run.  So it is
# with locks, without them, and where the frozen one is of another machine whose locks are not seen.
source "$(dirname "$0")/../cli/common.bash"
refuse=$DOMEFALL_SOURCE/tests/cli/refuse_calls.py

cat >fall.yaml <<'END'
title: A fall for two
frames_per_second: 12
size: 512
black_hole: {mass_solar: 4.3e6}
sky: {region_I: {stars: naked_eye}}
timeline: [{duration_s: 1, trajectory: {type: infall, from_r: 6, to_r: 2.5}}]
END
exits 0 "$DOMEFALL" render fall.yaml --frames 0-3 --out single

# A file in the making by the process with this number.
begun_by() { find both -name ".*-$1-*.tmp" | head -1; }

with_locks() { exec "$@"; }
without_locks() { exec python3 "$refuse" lock ENOLCK "$@"; }
# What a machine knows of another one's processes: neither its boot nor its locks.
echo 01234567-89ab-cdef-0123-456789abcdef >boot_id
of_another_machine() {
  # shellcheck disable=SC2016  # the inner shell expands
  exec unshare --mount sh -c 'mount --bind "$1" /proc/sys/kernel/random/boot_id && shift && exec "$@"' sh \
    "$folder/boot_id" python3 "$refuse" lock ENOLCK "$@"
}

# Whether each thread of a process has stopped.
stands_still() { ! grep -hs '^State:' "/proc/$1"/task/*/status | grep -qv 'T (stopped)'; }

# frozen_writer HOW: two writers into an empty folder, of which the first is started by HOW.  False if it was not
# frozen in the middle of a file.
frozen_writer() {
  local how=$1 frozen file kind
  rm -rf both
  mkdir -p both/farm
  ("$how" "$DOMEFALL" render fall.yaml --frames 0-3 --out both 2>first) &
  frozen=$!
  until [ -n "$(begun_by "$frozen")" ] || ! kill -0 "$frozen" 2>/dev/null; do :; done
  kill -STOP "$frozen" 2>/dev/null || true
  # It stops a moment after it is told to, and may give the file its name before.
  until ! [ -e "/proc/$frozen/exe" ] || stands_still "$frozen"; do :; done
  file=$(begun_by "$frozen")

  # The other makes what is not there; a third looks at all.  Both sweep.
  exits 0 "$DOMEFALL" render fall.yaml --frames 0-3 --out both
  exits 0 "$DOMEFALL" render fall.yaml --frames 0-3 --out both
  says '^0 frames made, 4 already there'
  [ -z "$file" ] || [ -e "$file" ] || fail "$how: the file of a writer that lives was removed"
  for kind in linear graded; do same_visible $kind; done

  kill -CONT "$frozen" 2>/dev/null || true
  wait "$frozen" || fail "$how: the frozen writer failed: $(cat first)"
  [ -z "$(find both -name '.*.tmp')" ] || fail "$how: temporaries were left: $(ls -A both/*)"
  for kind in linear graded; do same_frames single/$kind both/$kind; done
  exits 0 "$DOMEFALL" farm verify both --show fall.yaml --frames 0-3
  [ -n "$file" ]
}
# The frames, without the file in the making.
same_visible() { diff -r -x '.*' "single/$1" "both/$1" >/dev/null || fail "both/$1 differs"; }

met=''
for how in with_locks without_locks of_another_machine; do
  if ! ("$how" /bin/true 2>stderr); then
    echo "$how: cannot be tried here: $(cat stderr)"
    continue
  fi
  for try in $(seq 1 20); do
    ! frozen_writer "$how" || break
    [ "$try" -lt 20 ] || fail "$how: never frozen in the middle of a file"
  done
  met+=" $how"
done
echo "frozen in the middle of a file:$met"

# Two that start together and are frozen by nobody.
rm -rf both
mkdir -p both/farm
"$DOMEFALL" render fall.yaml --frames 0-3 --out both 2>first &
exits 0 "$DOMEFALL" render fall.yaml --frames 0-3 --out both
wait $! || fail "of two at once, one failed: $(cat first)"
for kind in linear graded; do same_frames single/$kind both/$kind; done
exits 0 "$DOMEFALL" farm verify both --show fall.yaml --frames 0-3
