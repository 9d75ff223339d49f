#!/usr/bin/env bash
# farm/render-local against a single run: the same bytes, whatever happens to the workers.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=farm_test.bash
source "$(dirname "${BASH_SOURCE[0]}")/farm_test.bash"
trap 'end_marked; rm -rf "$scratch"' EXIT
cd "$scratch"
write_show fall.yaml
launch=("$farm/render-local" fall.yaml --workers 2 --threads 2)

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

"$DOMEFALL" render fall.yaml --out single --threads 1 2>single.log

two_workers_make_the_bytes_of_a_single_run() {
  expect 0 two.log "${launch[@]}" --out two --frames 0-19 --chunk 6
  says two.log "[4/4]"
  says two.log "all 20 frames are there"
  same_frames single two 20 || fail "the frames differ"
  made two >two.made
  expect 0 again.log "${launch[@]}" --out two --frames 0-19 --chunk 20
  made two | cmp - two.made || fail "frames were made twice"
}

a_range_may_be_split_and_joined() {
  expect 0 part.log "${launch[@]}" --out part --frames 5-8,2 --chunk 3
  [[ $(frames_in part) == 5 ]] || fail "not the 5 frames that were asked for"
  made part >part.made
  expect 0 rest.log "${launch[@]}" --out part --frames 0-9 --chunk 5
  still_made part.made part || fail "frames were made twice"
  same_frames single part 10 || fail "the frames differ"
}

a_killed_worker_loses_nothing() {
  local worker
  "${launch[@]}" --out killed --chunk 20 >killed.log 2>&1 &
  until_ok 20 at_least killed 6 || fail "no frames"
  worker=$(workers 0-19)
  made killed >killed.made
  kill -KILL "$worker"
  wait $! || fail "the launcher: exit code $?"
  says killed.log "frames 0-19: killed by SIGKILL"
  says killed.log "frames 0-19: next try in 1 s"
  same_frames single killed 40 || fail "the frames differ"
  no_temporaries killed || fail "temporary files are left"
  still_made killed.made killed || fail "frames were made twice"
}

a_stopped_run_and_a_killed_one_are_taken_up() {
  local code=0 launcher
  "${launch[@]}" --out torn --chunk 20 >stopped.log 2>&1 &
  until_ok 20 at_least torn 4 || fail "no frames"
  kill -TERM $!
  wait $! || code=$?
  [[ $code == 143 ]] || fail "stopped by SIGTERM: exit code $code, not 143"
  # Both chunks had begun; without the signal they would have been made.
  (($(frames_in torn) < 40)) || fail "the workers were not told to stop"
  [[ -z $(workers) ]] || fail "workers outlive their launcher"
  no_temporaries torn || fail "temporary files are left"
  says stopped.log "missing: frames "
  made torn >stopped.made

  "${launch[@]}" --out torn --chunk 20 >torn.log 2>&1 &
  launcher=$!
  until_ok 20 at_least torn $(($(frames_in torn) + 4)) || fail "no frames"
  # shellcheck disable=SC2046 # one word for each worker
  kill -KILL "$launcher" $(workers)
  wait "$launcher" 2>/dev/null || true
  made torn >torn.made
  (($(frames_in torn) < 40)) || fail "too late: all frames are made"

  expect 0 resumed.log "${launch[@]}" --out torn --chunk 20
  same_frames single torn 40 || fail "the frames differ"
  still_made stopped.made torn || fail "frames from before the stop were made twice"
  still_made torn.made torn || fail "frames from before the kill were made twice"
}

a_full_disk_is_tried_again() {
  write_full_disk_program full space
  DOMEFALL=./full expect 75 full.log "${launch[@]}" --out full.d --frames 0-3 --chunk 4 --retries 1
  says full.log "frames 0-3: exit code 75"
  says full.log "given up after 2 tries"
  says full.log "missing: frames 0-3 (4 of 4)"

  DOMEFALL=./full "${launch[@]}" --out full.d --frames 0-9 --chunk 10 >healed.log 2>&1 &
  until_ok 20 grep -q "next try" healed.log || fail "not tried again"
  touch space
  wait $! || fail "the launcher: exit code $?"
  same_frames single full.d 10 || fail "the frames differ"
}

a_wrong_input_is_not_tried_again() {
  sed 's/from_r: 4/from_r: -4/' fall.yaml >wrong.yaml
  expect 2 wrong.log "$farm/render-local" wrong.yaml --out wrong.d
  says wrong.log "wrong.yaml:9:"
  [[ ! -e wrong.d ]] || fail "a wrong show left a folder"
  expect 2 size.log "${launch[@]}" --out wrong.d --size 5 --chunk 2
  says size.log "--size 5:"
  says_not size.log "next try"
  (($(grep -c 'exit code 2' size.log) <= 2)) || fail "went on after exit code 2"
  expect 2 frames.log "${launch[@]}" --out wrong.d --frames 0-40
}

what_is_anothers_is_refused_before_a_worker_starts() {
  expect 0 small.log "${launch[@]}" --out small --frames 0-3 --size 32
  made small >small.made
  expect 2 refused.log "${launch[@]}" --out small --frames 0-7
  says refused.log "small: 4 good frames of another size, show or kind would be replaced"
  says_not refused.log "exit code"
  made small | cmp - small.made || fail "frames were replaced unasked"
  expect 0 replaced.log "${launch[@]}" --out small --frames 0-7 --replace
  same_frames single small 8 || fail "the frames differ"
}

# The chunks that begin after the edit are of another version than those before.
a_show_edited_during_the_run_is_noticed() {
  cp fall.yaml kept.yaml
  "${launch[@]}" --out edited --chunk 4 >edited.log 2>&1 &
  until_ok 20 at_least edited 4 || fail "no frames"
  sed -i 's/from_r: 30/from_r: 31/' fall.yaml
  code=0
  wait $! || code=$?
  [[ $code == 75 ]] || fail "a show was edited, and the exit code is $code"
  says edited.log "the show or its assets were changed during the run: "
  says_not edited.log "frames are there"
  mv kept.yaml fall.yaml
  expect 0 mended.log "${launch[@]}" --out edited --chunk 4
  grep -qE '^segments? 1( and 2)?: [0-9]+ frames will be made again$' mended.log ||
    fail "what is made again is not told: $(cat mended.log)"
  same_frames single edited 40 || fail "the frames differ"
}

# Others rename the folder of the show, or write the show anew, while chunks begin.
a_show_that_is_away_or_half_written_is_waited_for() {
  mkdir shows
  cp fall.yaml shows/fall.yaml
  "$farm/render-local" shows/fall.yaml --workers 2 --threads 2 --out away --frames 0-7 --chunk 1 \
    >away.log 2>&1 &
  until_ok 20 at_least away 2 || fail "no frames"
  mv shows gone
  until_ok 20 grep -q "^shows/fall.yaml: away for now" away.log || fail "it is not missed"
  mv gone shows
  until_ok 20 at_least away 5 || fail "it is not taken up again"
  head -c 150 fall.yaml >half && mv half shows/fall.yaml
  until_ok 20 grep -q "exit code 2" away.log || fail "the half show is not noticed"
  cp fall.yaml whole && mv whole shows/fall.yaml
  wait $! || fail "the launcher: exit code $?: $(cat away.log)"
  same_frames single away 8 || fail "the frames differ"
}

# The worker begins while the show is there and reads it while it is not: the program, in its place,
# renames it before and leaves it away for a second.
a_show_that_vanishes_under_a_worker_is_waited_for() {
  cat >vanishing <<SCRIPT
#!/bin/bash
if [[ \$1 == render && "\$*" != *--dry-run* && ! -e vanished ]]; then
  touch vanished && mv away.yaml gone.yaml && { sleep 1 && mv gone.yaml away.yaml; } &
  until [[ ! -e away.yaml ]]; do sleep 0.02; done
fi
exec $DOMEFALL "\$@"
SCRIPT
  chmod +x vanishing
  cp fall.yaml away.yaml
  DOMEFALL=./vanishing expect 0 vanished.log "$farm/render-local" away.yaml --out vanished.d \
    --frames 0-3 --workers 1 --chunk 2
  says vanished.log "away.yaml: No such file or directory"
  says vanished.log "away.yaml: away for now"

  mkdir never
  cp fall.yaml never
  "$farm/render-local" never/fall.yaml --out never.d --workers 1 --chunk 1 --retries 1 >never.log 2>&1 &
  until_ok 20 at_least never.d 2 || fail "no frames"
  rm never/fall.yaml
  code=0
  wait $! || code=$?
  [[ $code == 75 ]] || fail "a show that is gone: exit code $code, not 75: $(cat never.log)"
  says never.log "never/fall.yaml: still away after 1 s; given up"
}

missed_or_made() { [[ -e moved ]] || grep -q "^moved: away for now" moved.log; }

a_folder_that_is_away_is_not_made_anew() {
  local tries
  for tries in 1 2 3 4 5 6; do
    "${launch[@]}" --out moved --frames 0-7 --chunk 1 >moved.log 2>&1 &
    until_ok 20 at_least moved 2 || fail "no frames"
    mv moved elsewhere.d
    until_ok 20 missed_or_made || fail "the folder is not missed"
    # Longer than the pause before a second try, while the workers that had begun have ended.
    [[ -e moved ]] || until_ok 20 no_workers || fail "the workers do not end"
    [[ -e moved ]] || break
    # A worker was just about to begin, and made the folder: this moment is not the launcher's.
    ((tries < 6)) || fail "the folder is made anew each time: $(cat moved.log)"
    kill -TERM $!
    wait $! || true
    rm -rf moved elsewhere.d
  done
  sleep 1.5
  [[ ! -e moved ]] || fail "another folder was made: $(cat moved.log)"
  mv elsewhere.d moved
  wait $! || fail "the launcher: exit code $?: $(cat moved.log)"
  [[ ! -e moved/elsewhere.d ]] || fail "the folder came back into another one"
  same_frames single moved 8 || fail "the frames differ"

  touch file
  expect 2 file.log "${launch[@]}" --out file --frames 0
  says file.log "file: the folder cannot be made: File exists"
}
no_workers() { [[ -z $(workers) ]]; }

a_show_that_is_made_wrong_ends_the_run() {
  mkdir turned
  cp fall.yaml turned
  "$farm/render-local" turned/fall.yaml --out turned.d --workers 1 --chunk 1 >turned.log 2>&1 &
  until_ok 20 at_least turned.d 2 || fail "no frames"
  sed -i 's/from_r: 4/from_r: -4/' turned/fall.yaml
  code=0
  wait $! || code=$?
  [[ $code == 2 ]] || fail "a show that was made wrong: exit code $code, not 2: $(cat turned.log)"
  [[ $(grep -c "exit code 2" turned.log) == 3 ]] || fail "not tried 3 times: $(cat turned.log)"
}

a_stopped_worker_is_continued_and_then_killed() {
  local worker
  "${launch[@]}" --out halted --workers 1 --chunk 40 >halted.log 2>&1 &
  until_ok 20 at_least halted 2 || fail "no frames"
  worker=$(workers)
  kill -STOP "$worker"
  until_ok 20 grep -q "process $worker was stopped; continued" halted.log || fail "not continued"
  until_ok 20 at_least halted $(($(frames_in halted) + 2)) || fail "it does not go on"
  kill -STOP "$worker"
  until_ok 20 grep -q "frames 0-39: killed by SIGKILL" halted.log || fail "it is not killed"
  wait $! || fail "the launcher: exit code $?: $(cat halted.log)"
  says halted.log "process $worker was stopped; killed"
  same_frames single halted 40 || fail "the frames differ"
}

# The launcher is stopped first, so that it is the signal that continues the worker.
a_stopped_worker_does_not_outlive_the_end_of_the_run() {
  local code=0 launcher
  "${launch[@]}" --out frozen --workers 1 --chunk 40 >frozen.log 2>&1 &
  launcher=$!
  until_ok 20 at_least frozen 2 || fail "no frames"
  kill -STOP "$launcher" "$(workers)"
  kill -TERM "$launcher"
  kill -CONT "$launcher"
  until_ok 20 grep -q "missing: frames" frozen.log || fail "SIGTERM does not end the run"
  wait "$launcher" || code=$?
  [[ $code == 143 ]] || fail "stopped by SIGTERM: exit code $code, not 143: $(cat frozen.log)"
  (($(frames_in frozen) < 40)) || fail "the worker was not told to stop"
  [[ -z $(workers) ]] || fail "the worker outlives its launcher"
}

# A program that is not there for a moment, as on a file server that pauses.
a_worker_that_cannot_be_started_is_tried_again() {
  cat >coming <<SCRIPT
#!/bin/bash
[[ \$1 != render || "\$*" == *--dry-run* || -e began ]] || { touch began && mv coming gone; }
exec $DOMEFALL "\$@"
SCRIPT
  chmod +x coming
  DOMEFALL=./coming "${launch[@]}" --out coming.d --frames 0-5 --chunk 2 --workers 1 >coming.log 2>&1 &
  until_ok 60 grep -q "a worker cannot be started: " coming.log || fail "all workers were started"
  mv gone coming
  wait $! || fail "the launcher: exit code $?: $(cat coming.log)"
  same_frames single coming.d 6 || fail "the frames differ"
}

for claim in two_workers_make_the_bytes_of_a_single_run a_range_may_be_split_and_joined \
  a_killed_worker_loses_nothing a_stopped_run_and_a_killed_one_are_taken_up \
  a_full_disk_is_tried_again a_wrong_input_is_not_tried_again \
  what_is_anothers_is_refused_before_a_worker_starts a_show_edited_during_the_run_is_noticed \
  a_show_that_is_away_or_half_written_is_waited_for \
  a_show_that_vanishes_under_a_worker_is_waited_for a_show_that_is_made_wrong_ends_the_run \
  a_folder_that_is_away_is_not_made_anew a_stopped_worker_is_continued_and_then_killed \
  a_stopped_worker_does_not_outlive_the_end_of_the_run \
  a_worker_that_cannot_be_started_is_tried_again; do
  $claim
  pass "$claim"
done
