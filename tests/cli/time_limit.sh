#!/usr/bin/env bash
# SIGUSR1, by which queue managers tell that a time limit is near: the frame is finished, and the code
# is that of what is worth another try.
# shellcheck source=tests/cli/common.bash
source "$(dirname "$0")/common.bash"
cd "$folder"
cat >long.yaml <<'END'
frames_per_second: 12
size: 64
black_hole: {mass_solar: 4.3e6}
sky: {region_I: {background: grid, stars: none}}
timeline: [{duration_s: 5000, trajectory: {type: infall, from_r: 6, to_r: 2.5}}]
END
"$DOMEFALL" render long.yaml --out out --threads 1 2>stderr &
until compgen -G 'out/graded/long_*' >/dev/null; do sleep 0.02; done
kill -USR1 $!
code=0
wait $! || code=$?
[ "$code" -eq 75 ] || fail "exit code $code: $(cat stderr)"
says 'stopped; run the same command again to go on'
[ -z "$(find out -name '.*' -type f)" ] || fail "something unfinished is left: $(find out -name '.*')"
