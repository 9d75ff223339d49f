#!/usr/bin/env bash
# SIGUSR1, by which queue managers tell that a time limit is near: the frame is finished, and the code
# is that of what is worth another try.
source "$(dirname "$0")/common.bash"
write_grid_show long.yaml 64 5000
"$DOMEFALL" render long.yaml --out out --threads 1 2>stderr &
until compgen -G 'out/graded/long_*' >/dev/null; do sleep 0.02; done
kill -USR1 $!
ended 75 $!
says 'stopped; run the same command again to go on'
[ -z "$(find out -name '.*' -type f)" ] || fail "something unfinished is left: $(find out -name '.*')"
