#!/usr/bin/env bash
# 0 done; 2 the input is wrong; 75 worth trying again; 128 + n stopped by signal n. stdout is data, stderr is talk.
source "$(dirname "$0")/common.bash"
write_show fall.yaml

exits 0 "$DOMEFALL" --help
exits 0 "$DOMEFALL" check fall.yaml
exits 2 "$DOMEFALL" check none.yaml
says '^none.yaml: '
[ ! -s stdout ] || fail "talk on stdout"
exits 2 "$DOMEFALL" render fall.yaml --frames 5-99
says '23'
exits 2 "$DOMEFALL" render fall.yaml --frames x
exits 2 "$DOMEFALL" render fall.yaml --size 5m --out o
says 'size 5m'
sed 's/size: 96/size: 9x/' fall.yaml >bad.yaml
exits 2 "$DOMEFALL" render bad.yaml --out o
says '^bad.yaml:3:7: size '
[ ! -e o ] || fail "a broken show left a folder"

# A variable that a script has not set is no option that was left out, and no folder to wait for.
for empty in 'check' 'farm status' 'preview fall.yaml --at 0:01 --out' 'movie fall.yaml --preset dome --from'; do
  # shellcheck disable=SC2086 # words
  exits 2 "$DOMEFALL" $empty ''
  says "^argument [0-9], after '.*', is empty"
done

# A folder that is a file.
touch occupied
exits 2 "$DOMEFALL" render fall.yaml --out occupied
says '^occupied/linear: '

# A disk that fills up: a limit on the size of files refuses in the middle of a write, as it does.
exits 75 bash -c "trap '' XFSZ; ulimit -f 8; exec '$DOMEFALL' render fall.yaml --out full"
says '^full/(linear|graded)/fall_000.*: File too large'
[ -z "$(find full -type f)" ] || fail "a full disk left files: $(find full -type f | head -3)"
exits 0 "$DOMEFALL" render fall.yaml --frames 0-2 --out full

# Too little memory: for the program itself, for the threads of the run, and for the sky map.
for kilobytes in 60000 100000 150000; do
  exits 75 bash -c "ulimit -v $kilobytes; exec '$DOMEFALL' render fall.yaml --frames 0 --out little"
  [ -z "$(find little -name '*.tmp' 2>/dev/null)" ] || fail "little memory left temporaries"
done

# Data that did not reach its reader is no success.
exits 75 bash -c "'$DOMEFALL' states fall.yaml >/dev/full"
says '^standard output: '
# So it is where printing fails in the middle of a verb. A reader that goes has what it asked for.
awk 'BEGIN { print "observer,r,delta"; for (k = 0; k < 3000; ++k) print "rain,10,1" }' >rays.csv
exits 75 bash -c "'$DOMEFALL' trace --table rays.csv >/dev/full"
says '^standard output: '
exits 141 bash -c "set -o pipefail; '$DOMEFALL' trace --table rays.csv | head -n 1"
[ ! -s "$folder/stderr" ] || fail "a reader that goes is no mistake: $(cat "$folder/stderr")"

# Asked to stop, it ends in order, and may be sent again.
"$DOMEFALL" render fall.yaml --size 2k --out stopped 2>stderr &
stopped=$!
until [ -n "$(find stopped -name '*.exr' 2>find.stderr)" ]; do sleep 0.05; done
kill -TERM $stopped
ended 143 $stopped
[ -z "$(find stopped -name '*.tmp')" ] || fail "a stopped run left temporaries"
