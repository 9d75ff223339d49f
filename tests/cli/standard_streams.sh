#!/usr/bin/env bash
# What becomes of a run whose standard streams are closed, or whose reader goes, or whose files may not grow.
source "$(dirname "$0")/common.bash"
write_grid_show tiny.yaml 128 1

# What is said to a closed stream must not go into the file that has got its number.
exits 0 "$DOMEFALL" render tiny.yaml --out whole
for streams in '2>&-' '1>&- 2>&-' '0<&- 1>&- 2>&-'; do
  exits 0 bash -c "'$DOMEFALL' render tiny.yaml --out closed --explain $streams"
  same_frames whole closed
  rm -r closed
done
exits 75 bash -c "'$DOMEFALL' states tiny.yaml >&-"
says '^standard output: '

# unread STREAM COMMAND...: runs it with this stream (1 or 2) going into a pipe whose reader has gone.
unread() {
  python3 -c '
import os, subprocess, sys
reader, writer = os.pipe()
os.close(reader)
streams = {["stdout", "stderr"][int(sys.argv[1]) - 1]: writer}
code = subprocess.run(sys.argv[2:], **streams).returncode
sys.exit(code if code >= 0 else 128 - code)' "$@"
}

# A reader of the talk who goes does not end the run.
exits 0 unread 2 "$DOMEFALL" render tiny.yaml --out unheard --explain
same_frames whole unheard

# A reader of the data who goes ends it as the signal of a broken pipe would.
exits 141 unread 1 "$DOMEFALL" states tiny.yaml
[ ! -s stderr ] || fail "a word about a reader who has seen enough: $(cat stderr)"

# A limit on the size of files comes as a signal where nobody ignores it.
exits 75 bash -c "ulimit -f 1; exec '$DOMEFALL' states tiny.yaml --plot tiny.svg"
says '^tiny.svg: File too large$'
[ "$(find . -name 'tiny.svg*' -o -name '.tiny*' | wc -l)" -eq 0 ] || fail "left: $(ls -A)"
