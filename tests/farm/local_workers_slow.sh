#!/usr/bin/env bash
# domefall farm submit --engine local against a single run: the same bytes, whatever happens to workers.
source "$(dirname "$0")/farm_test.bash"
local_farm=("$DOMEFALL" farm submit --engine local)
launch=("${local_farm[@]}" fall.yaml --workers 2 --threads 2)
launch_one=("${local_farm[@]}" fall.yaml --workers 1)

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
  write_program dying <<'SCRIPT'
  if on 0-19 && once dying; then
    first 0-19 0-5
    find "$scratch/killed" -name 'fall_*' -printf '%f %i %T@\n' | sort >"$scratch/killed.made"
    kill -KILL $$
  fi
SCRIPT
  expect 0 killed.log "${launch[@]}" --program ./dying --out killed --chunk 20
  says killed.log "frames 0-19: killed by SIGKILL"
  says killed.log "frames 0-19: next try in 1 s"
  same_frames single killed 40 || fail "the frames differ"
  no_temporaries killed/linear || fail "temporary files are left"
  [[ $(grep -c linear <(find killed -name 'fall_0000[0-5].exr')) == 6 ]] || fail "frames are lost"
  still_made killed.made killed || fail "frames were made twice"
}

a_stopped_run_and_a_killed_one_are_taken_up() {
  local code=0 launcher
  write_program pausing <<'SCRIPT'
  if on 0-19; then first 0-19 0-2; else first 20-39 20-22; fi
  wait_for pausing.go
SCRIPT
  "${launch[@]}" --program ./pausing --out torn --chunk 20 >stopped.log 2>&1 &
  until_ok 40 at_least torn 6 || fail "no frames"
  kill -TERM $!
  wait $! || code=$?
  [[ $code == 143 ]] || fail "stopped by SIGTERM: exit code $code, not 143"
  [[ $(frames_in torn) == 6 ]] || fail "the workers were not told to stop"
  [[ -z $(workers) ]] || fail "workers outlive their launcher"
  no_temporaries torn/linear || fail "temporary files are left"
  says stopped.log "SIGTERM: the workers finish their frames; once more ends them at once"
  says stopped.log "run the same command again to go on"
  made torn >stopped.made

  # What is left is 3-39, in chunks of 20 again: their first frames are made, and then they wait.
  write_program pausing <<'SCRIPT'
  if on 3-19,23-25; then first 3-19,23-25 3; else first 26-39 26; fi
  wait_for pausing.go
SCRIPT
  "${launch[@]}" --program ./pausing --out torn --chunk 20 >torn.log 2>&1 &
  launcher=$!
  until_ok 40 at_least torn 8 || fail "no frames"
  # shellcheck disable=SC2046 # one word for each worker
  kill -KILL "$launcher" $(workers)
  wait "$launcher" 2>/dev/null || true
  made torn >torn.made
  expect 0 resumed.log "${launch[@]}" --out torn --chunk 20
  same_frames single torn 40 || fail "the frames differ"
  still_made stopped.made torn || fail "frames from before the stop were made twice"
  still_made torn.made torn || fail "frames from before the kill were made twice"
}

a_full_disk_is_tried_again() {
  write_full_disk_program full space
  expect 75 full.log "${launch[@]}" --program ./full --out full.d --frames 0-3 --chunk 4 --retries 1
  says full.log "frames 0-3: exit code 75"
  says full.log "given up after 2 tries"
  says full.log "missing, damaged or of another version: frames 0-3 (4 of 4)"

  "${launch[@]}" --program ./full --out full.d --frames 0-9 --chunk 10 >healed.log 2>&1 &
  until_ok 20 grep -q "next try" healed.log || fail "not tried again"
  touch space
  wait $! || fail "the launcher: exit code $?"
  same_frames single full.d 10 || fail "the frames differ"
}

a_wrong_input_is_not_tried_again() {
  sed 's/from_r: 4/from_r: -4/' fall.yaml >wrong.yaml
  expect 2 wrong.log "${local_farm[@]}" wrong.yaml --out wrong.d
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

# The chunks that begin after the edit are of another version than those before, which a further round
# makes anew.
a_show_edited_during_the_run_is_noticed() {
  cp fall.yaml kept.yaml
  write_program late <<'SCRIPT'
  if on 4-7; then wait_for late.go; fi
SCRIPT
  "${launch[@]}" --program ./late --out edited --chunk 4 --frames 0-15 >edited.log 2>&1 &
  until_ok 40 at_least edited 12 || fail "no frames"
  sed -i 's/from_r: 30/from_r: 31/' fall.yaml
  touch late.go
  wait $! || fail "exit code $?: $(cat edited.log)"
  says edited.log "round 1 of at most 2: frames 0-3,8-15 (12 of 16) are rendered again"
  "$DOMEFALL" render fall.yaml --out edited --frames 0-15 --dry-run >edited.left 2>/dev/null
  [[ ! -s edited.left ]] || fail "frames of the show before it was edited: $(cat edited.left)"
  mv kept.yaml fall.yaml
  expect 0 mended.log "${launch[@]}" --out edited --chunk 4 --frames 0-15
  grep -qE '^segment 1: 16 frames will be made again$' mended.log ||
    fail "what is made again is not told: $(cat mended.log)"
  same_frames single edited 16 || fail "the frames differ"
}

# Others rename the folder of the show, or write the show anew, while chunks begin.
a_show_that_is_away_or_half_written_is_waited_for() {
  mkdir shows
  cp fall.yaml shows/fall.yaml
  head -c 150 fall.yaml >half
  write_program renaming <<'SCRIPT'
  if on 2 && once gone; then mv "$scratch/shows" "$scratch/gone"; fi
  if on 5 && once half; then
    cp "$scratch/half" "$scratch/half.new" && mv "$scratch/half.new" "$scratch/shows/fall.yaml"
    "$domefall" "$@"
    code=$?
    cp "$scratch/fall.yaml" "$scratch/whole" && mv "$scratch/whole" "$scratch/shows/fall.yaml"
    exit "$code"
  fi
SCRIPT
  "${local_farm[@]}" shows/fall.yaml --workers 2 --threads 2 --program ./renaming --out away \
    --frames 0-7 --chunk 1 --retries 6 >away.log 2>&1 &
  until_ok 40 grep -q "shows/fall.yaml: away for now" away.log || fail "it is not missed"
  mv gone shows
  wait $! || fail "exit code $?: $(cat away.log)"
  grep -q "^$scratch/shows/fall.yaml:" away/farm/log/local_*_0_5.log || fail "the half show is not noticed"
  same_frames single away 8 || fail "the frames differ"
}

# The worker begins while the show is there and reads it while it is not.
a_show_that_vanishes_under_a_worker_is_waited_for() {
  write_program vanishing <<'SCRIPT'
  if once vanished; then mv "$scratch/away.yaml" "$scratch/gone.yaml"; fi
SCRIPT
  cp fall.yaml away.yaml
  "${local_farm[@]}" away.yaml --program ./vanishing --out vanished.d --frames 0-3 --workers 1 \
    --chunk 2 --retries 6 >vanished.log 2>&1 &
  until_ok 40 grep -q "away.yaml: away for now" vanished.log || fail "it is not missed"
  mv gone.yaml away.yaml
  wait $! || fail "exit code $?: $(cat vanished.log)"
  says vanished.d/farm/log/local_*_0_0.log "away.yaml: No such file or directory"

  mkdir never
  cp fall.yaml never
  write_program removing <<'SCRIPT'
  if on 2; then rm "$scratch/never/fall.yaml"; fi
SCRIPT
  expect 75 never.log "${local_farm[@]}" never/fall.yaml --program ./removing --out never.d \
    --frames 0-5 --workers 1 --chunk 1 --retries 1
  says never.log "never/fall.yaml: still away after 1 s; given up"
}

a_folder_that_is_away_is_not_made_anew() {
  write_program moving <<'SCRIPT'
  if on 2 && once moved; then
    mv "$scratch/moved" "$scratch/elsewhere.d"
    exit 75
  fi
SCRIPT
  "${launch_one[@]}" --program ./moving --out moved --frames 0-7 --chunk 1 --retries 6 \
    >moved.log 2>&1 &
  until_ok 40 grep -q "moved: away for now" moved.log || fail "the folder is not missed"
  # Longer than the pause before a second try.
  sleep 1.2
  [[ ! -e moved ]] || fail "another folder was made: $(cat moved.log)"
  mv elsewhere.d moved
  wait $! || fail "exit code $?: $(cat moved.log)"
  [[ ! -e moved/elsewhere.d ]] || fail "the folder came back into another one"
  same_frames single moved 8 || fail "the frames differ"

  touch file
  expect 2 file.log "${launch[@]}" --out file --frames 0
  says file.log "$scratch/file"
}
a_show_that_is_made_wrong_ends_the_run() {
  mkdir turned
  cp fall.yaml turned
  write_program turning <<'SCRIPT'
  if on 2; then sed -i 's/from_r: 4/from_r: -4/' "$scratch/turned/fall.yaml"; fi
SCRIPT
  expect 2 turned.log "${local_farm[@]}" turned/fall.yaml --program ./turning --out turned.d \
    --frames 0-7 --workers 1 --chunk 1
  [[ $(grep -c "^$scratch/turned/fall.yaml:9" turned.d/farm/log/local_*_0_2.log) == 3 ]] ||
    fail "not tried 3 times: $(cat turned.d/farm/log/local_*_0_2.log)"
  says turned.log "frames 2: exit code 2: "
  [[ $(frames_in turned.d) == 2 ]] || fail "it went on"
}

a_stopped_worker_is_continued_and_then_killed() {
  write_program halting <<'SCRIPT'
  if once halting; then
    first 0-39 0-1
    kill -STOP $$
    first 0-39 0-3
    kill -STOP $$
    sleep 60
  fi
SCRIPT
  expect 0 halted.log "${launch_one[@]}" --program ./halting --out halted --chunk 40
  grep -qE "^frames 0-39: process [0-9]+ was stopped; continued" halted/farm/log/local_* || fail "not continued"
  grep -qE "^frames 0-39: process [0-9]+ was stopped; killed" halted/farm/log/local_* || fail "not killed"
  says halted.log "frames 0-39: killed by SIGKILL"
  same_frames single halted 40 || fail "the frames differ"
}

# Those above the worker are stopped first, so that it is the signal that continues it.
a_stopped_worker_does_not_outlive_the_end_of_the_run() {
  local code=0 launcher work
  write_program frozen.p <<'SCRIPT'
  first 0-39 0-2
  wait_for frozen.go
SCRIPT
  "${launch_one[@]}" --program ./frozen.p --out frozen --chunk 40 >frozen.log 2>&1 &
  launcher=$!
  until_ok 40 at_least frozen 3 || fail "no frames"
  work=$(ps -o ppid= -p "$(workers | head -1)" | tr -d ' ')
  # shellcheck disable=SC2046 # one word for each worker
  kill -STOP "$launcher" "$work" $(workers)
  kill -TERM "$launcher"
  kill -CONT "$launcher"
  wait "$launcher" || code=$?
  [[ $code == 143 ]] || fail "stopped by SIGTERM: exit code $code, not 143: $(cat frozen.log)"
  [[ $(frames_in frozen) == 3 ]] || fail "the worker was not told to stop"
  until_ok 5 no_workers || fail "the worker outlives its launcher"
}
no_workers() { [[ -z $(workers) ]]; }

# A program that is not there for a moment, as on a file server that pauses.
a_worker_that_cannot_be_started_is_tried_again() {
  cat >coming <<SCRIPT
#!/bin/bash
[[ \$1 != render || "\$*" == *--dry-run* || -e began ]] || { touch began && mv coming gone; }
exec $DOMEFALL "\$@"
SCRIPT
  chmod +x coming
  "${launch_one[@]}" --program ./coming --out coming.d --frames 0-5 --chunk 2 >coming.log 2>&1 &
  until_ok 60 grep -q "a worker cannot be started: " coming.log || fail "all workers were started"
  mv gone coming
  wait $! || fail "the launcher: exit code $?: $(cat coming.log)"
  same_frames single coming.d 6 || fail "the frames differ"
}

try_all_claims
