#!/usr/bin/env bash
# What several submissions into one folder do to each other, and how long a plan is true.
source "$(dirname "$0")/farm_test.bash"
"$DOMEFALL" render fall.yaml --out single --frames 0-9 --threads 1 2>single.log
submit=("$DOMEFALL" farm submit fall.yaml)
local_run=("${submit[@]}" --engine local --workers 1 --threads 1 --out both)
status() { "$DOMEFALL" farm status "$@" >status.out 2>&1 || fail "$(cat status.out)"; }

# The first one begins its second chunk when the other one has ended.
two_runs_into_a_folder_make_their_own_frames() {
  write_program waiting <<'SCRIPT'
  if on 0-2; then first 0-2 0; wait_for other.done; fi
SCRIPT
  "${local_run[@]}" --program ./waiting --frames 0-5 --chunk 3 >first.log 2>&1 &
  until_ok 40 at_least both 1 || fail "no frames: $(cat first.log)"
  # One that only prints leaves the run alone, too.
  "${submit[@]}" --engine list --out both --frames 20-29 --chunk 1 >commands.txt
  expect 0 second.log "${local_run[@]}" --frames 6-9 --chunk 1
  says second.log "all 4 frames are there"
  touch other.done
  wait $! || fail "the first run: exit code $?: $(cat first.log)"
  says first.log "all 6 frames are there"
  same_frames single both 10 || fail "the frames differ"
}

status_tells_of_the_latest_plan_or_of_the_one_that_is_named() {
  local plan
  status both
  says status.out "4 of 4 frames are done"
  plan=$(grep -l '"frames": "0-5"' both/farm/plan_*.json)
  plan=$(basename "$plan" .json)
  status both --plan "${plan#plan_}"
  says status.out "6 of 6 frames are done"
  expect 2 slash.log "$DOMEFALL" farm status both --plan ../x
  says slash.log "expected the ID of a file farm/plan_ID.json"
}

# An engine that refuses it: Slurm's programs, of which sbatch fails.
what_an_engine_refuses_is_no_plan() {
  local name
  mkdir -p bin
  for name in scontrol sbatch; do
    printf '#!/bin/sh\n[ %s = scontrol ] && echo "MaxArraySize = 1001" && exit\n%s\n' "$name" \
      'echo "sbatch: error: invalid partition specified: nosuch" >&2; exit 1' >"bin/$name"
    chmod +x "bin/$name"
  done
  PATH=$scratch/bin:$PATH expect 2 refused.log "${submit[@]}" --engine slurm --out both --frames 10-15 \
    -- --partition=nosuch
  says refused.log "invalid partition specified: nosuch"
  [[ $(find both/farm -name 'plan_*' | wc -l) == 3 ]] || fail "the refused plan is kept"
  status both
  says status.out "4 of 4 frames are done"
}

# In the place of sbatch, a script that refuses as Slurm does where no node has so many processors.
a_refusal_for_its_processors_names_the_option() {
  local threads
  sed -i 's/echo "sbatch: error: .*"/echo "sbatch: error: CPU count per node can not be satisfied"/' bin/sbatch
  for threads in "" "--threads 3"; do
    # shellcheck disable=SC2086 # several words
    PATH=$scratch/bin:$PATH expect 2 refused.log "${submit[@]}" --engine slurm --out unfit $threads
    says refused.log "CPU count per node can not be satisfied"
    threads=${threads#--threads }
    says refused.log "a task asks for ${threads:-4} processors of a node; --threads asks for another number"
  done
}

# A user's own allocation, in which the submission is made, has the variables of a task.
an_allocation_of_the_users_own_is_no_task() {
  mkdir -p own
  printf '#!/bin/sh\necho "$@" >>%s/scontrol.log\n' "$scratch" >own/scontrol
  cp own/scontrol own/scancel
  chmod +x own/*
  # shellcheck disable=SC2016 # it is the script's
  printf '#!/bin/sh\n[ "$1" != render ] || exit 75\nexec "%s" "$@"\n' "$DOMEFALL" >failing
  chmod +x failing
  expect 75 own.log env PATH="$scratch/own:$PATH" SLURM_JOB_ID=4242 SLURM_ARRAY_JOB_ID=4242 \
    SLURM_ARRAY_TASK_ID=1 SLURMD_NODENAME=n1 SLURM_RESTART_COUNT=9 SLURM_CPUS_PER_TASK=64 \
    SLURM_CPUS_ON_NODE=64 "${submit[@]}" --engine local --program ./failing --retries 1 --rounds 0 \
    --frames 0-3 --chunk 2 --out own.d
  says own.log "given up after 2 tries"
  says_not own.log "back to the queue"
  [[ ! -e scontrol.log ]] || fail "scontrol $(cat scontrol.log)"
  # Nor do its variables say how many threads there are, or which log tells of the end.
  sed 's/exit 75/echo "$@" >>threads.log/' failing >counting
  chmod +x counting
  expect 0 own.log env SLURM_JOB_ID=4242 SLURM_CPUS_PER_TASK=64 "${submit[@]}" --engine local \
    --program ./counting --workers 1 --threads 2 --frames 0-1 --out own.d
  says threads.log "--threads 2"
  says_not threads.log "--threads 64"
  expect 2 task.log env -u SLURM_JOB_ID "$DOMEFALL" farm work own.d --plan x --task 0 --slurm
  says task.log "SLURM_JOB_ID names none"
}

# What sbatch is given, kept by a script in its place.
variables_that_would_change_a_submission_are_kept_from_slurm() {
  local name
  mkdir -p kept
  printf '#!/bin/sh\nenv >>%s/sbatch.env\necho 7\n' "$scratch" >kept/sbatch
  printf '#!/bin/sh\necho "MaxArraySize = 1001"\n' >kept/scontrol
  chmod +x kept/*
  expect 0 kept.log env PATH="$scratch/kept:$PATH" SBATCH_ARRAY_INX=0-9 SBATCH_WAIT=1 SBATCH_EXPORT=NONE \
    SBATCH_ERROR=lost SBATCH_SIGNAL=KILL@9 SLURM_RESTART_COUNT=9 SLURM_JOB_ID=4242 SLURM_ARRAY_JOB_ID=42 \
    SQUEUE_STATES=PD SBATCH_PARTITION=render SLURM_CONF=/etc/ours SITE=ours \
    "${submit[@]}" --engine slurm --out kept.d --frames 0-3
  for name in SBATCH_ARRAY_INX SBATCH_WAIT SBATCH_EXPORT SBATCH_ERROR SBATCH_SIGNAL SLURM_RESTART_COUNT \
    SLURM_JOB_ID SLURM_ARRAY_JOB_ID SQUEUE_STATES; do
    says_not sbatch.env "$name="
  done
  for name in SBATCH_PARTITION=render SLURM_CONF=/etc/ours SITE=ours; do
    [[ $(grep -cxF "$name" sbatch.env) == 2 ]] || fail "not $name: $(cat sbatch.env)"
  done
  # What is no job's number does not become an argument of Slurm's programs.
  sed -i 's/"job": "7"/"job": "--user=root"/' kept.d/farm/plan_*.json
  expect 2 job.log "$DOMEFALL" farm status kept.d
  says job.log "the job of a round must be a number, got '--user=root'"
}

a_plan_that_found_nothing_to_do_is_passed_over() {
  expect 0 idle.log "${local_run[@]}" --frames 6
  says idle.log "all 1 frames are there"
  status both
  says status.out "4 of 4 frames are done"
}

a_plan_of_all_frames_follows_the_show() {
  cp fall.yaml long.yaml
  expect 0 all.log "${submit[@]/fall.yaml/long.yaml}" --engine list --out follows
  sed -i 's/duration_s: 2, trajectory: {type: infall, from_r: 4/duration_s: 3, trajectory: {type: infall, from_r: 4/' long.yaml
  status follows
  says status.out "0 of 50 frames are done"
  sed -i '/from_r: 30/d' long.yaml
  status follows
  says status.out "0 of 30 frames are done"
  expect 1 verify.log "$DOMEFALL" farm verify follows
  says verify.log "0 of 30 frames are good"
}

# A dome's frames are no sphere's, an odd size suits no codec, a folder of others is no delivery.
what_cannot_follow_the_frames_is_refused_at_once() {
  mkdir taken
  touch taken/notes.txt
  for options in "--movie vr360" "--movie review --size 65" "--deliver taken"; do
    # shellcheck disable=SC2086 # several words
    expect 2 early.log "${submit[@]}" --engine local --out early $options
    [[ ! -e early ]] || fail "$options: frames were begun"
  done
  says early.log "taken: the folder is not empty and holds no delivery"
}

# JSON is UTF-8, and a file's name may be any bytes.
paths_that_no_plan_can_hold_are_refused_at_once() {
  local engine dry
  for engine in local list openjd flamenco; do
    for dry in "" --dry-run; do
      expect 2 bytes.log "${submit[@]}" --engine "$engine" --out $'early\xff' ${dry:+"$dry"}
      says bytes.log '/early\xFF: is not UTF-8'
      [[ ! -e $'early\xff' ]] || fail "--engine $engine $dry: a folder was made"
    done
  done
}

# What the options say is kept in the plan, and handed to the verbs that make movie and delivery.
sound_overlays_and_parts_of_a_delivery_are_checked_and_kept() {
  local options words
  python3 -c "
import wave
with wave.open('mix.wav', 'wb') as sound:
    sound.setparams((1, 2, 48000, 0, 'NONE', ''))
    sound.writeframes(bytes(2 * 4 * 48000))"
  printf '1\n00:00:00,100 --> 00:00:03,500\nA hole.\n' >words.srt
  while IFS='|' read -r options words; do
    # shellcheck disable=SC2086 # several words
    expect 2 product.log "${submit[@]}" --engine local --out early $options </dev/null
    says product.log "$words"
    [[ ! -e early ]] || fail "$options: frames were begun"
  done <<'CASES'
--audio mix.wav|--audio mix.wav: is the sound of --movie and --deliver
--movie review --audio none.wav|none.wav: No such file or directory
--leader|--leader: is of --deliver
--depth 8|--depth 8: is of --deliver
--deliver d --subtitles none.srt|none.srt: No such file or directory
--deliver d --audio words.srt|words.srt: no sound that can be used
--overlay nosuch|--overlay nosuch: overlays are grid
--program nosuch|--program nosuch: PATH has no such program
--program ./none|none: cannot be started: No such file or directory
--program /bin/true|and this is domefall
CASES
  expect 2 empty.log "${submit[@]}" --engine local --out ""
  expect 0 job.json "${submit[@]}" --engine openjd --out products --overlay burn_in --movie review \
    --deliver d --depth 8 --leader --audio mix.wav --subtitles words.srt
  python3 - job.json "$scratch" <<'PY'
import json, sys
job, folder = json.load(open(sys.argv[1])), sys.argv[2]
words = {s["name"]: " ".join(s["script"]["actions"]["onRun"]["args"]) for s in job["steps"]}
for step in ("render", "movie", "deliver"):
    assert "--overlay burn_in" in words[step], words
assert f"--audio {folder}/mix.wav" in words["movie"], words
assert f"--depth 8 --leader --audio {folder}/mix.wav --subtitles {folder}/words.srt" in words["deliver"], words
PY
  expect 0 heard.log "${submit[@]}" --engine local --out heard --frames 0-1 --overlay burn_in \
    --movie review --audio mix.wav
  [[ $(ffprobe -v error -show_entries stream=codec_type -of csv=p=0 heard/fall_review.mp4 | sort) == \
    $'audio\nvideo' ]] || fail "the movie has no sound"
  status heard
  says status.out "2 of 2 frames are done"
}

what_is_only_printed_needs_no_controller() {
  printf '#!/bin/sh\nexec sleep 30\n' >bin/scontrol
  PATH=$scratch/bin:$PATH expect 0 dry.log "${submit[@]}" --engine slurm --out dry --dry-run
  says dry.log "an array is taken to have 1001 tasks at most"
  says dry.log "sbatch --parsable"
}

a_list_takes_nothing_that_follows_the_frames() {
  expect 2 follows.log "${submit[@]}" --engine list --out listed --movie review
  says follows.log "--engine list: its lines make frames only"
  [[ ! -e listed ]] || fail "a folder was made"
}

# A movie's program that fails, and one that kills its parent.
what_fails_after_the_frames_is_told_by_status() {
  cat >movieless <<SCRIPT
#!/bin/bash
[[ \$1 != movie ]] || { echo "no room for a movie" >&2; exit 75; }
exec $DOMEFALL "\$@"
SCRIPT
  chmod +x movieless
  expect 75 movie.log "${submit[@]}" --engine local --program ./movieless --out reel --frames 0-1 \
    --movie review
  status reel
  says status.out "2 of 2 frames are done"
  says status.out "verification, movie and delivery: no room for a movie"
  # Jobs that conclude a round may be killed, and may be run again.
  # shellcheck disable=SC2016 # it is the script's parent
  sed -i 's/echo .*exit 75/kill -KILL $PPID; sleep 1/' movieless
  expect 137 killed.log "$DOMEFALL" farm conclude reel --plan "$(plan_in reel)"
  status reel
  says status.out "begun 2"
  says status.out ", not ended"
  sed -i '/movie/d' movieless
  expect 0 concluded.log "$DOMEFALL" farm conclude reel --plan "$(plan_in reel)"
  status reel
  says_not status.out "verification, movie and delivery"
  [[ -s reel/fall_review.mp4 ]] || fail "no movie"
}

what_ended_well_has_not_failed_when_the_show_is_edited() {
  cp fall.yaml edited.yaml
  expect 0 well.log "${submit[@]/fall.yaml/edited.yaml}" --engine local --out edited --frames 0-3
  sed -i 's/from_r: 30/from_r: 31/' edited.yaml
  status edited --json
  says status.out '"failed_chunks": []'
  says status.out '"stale": "0-3"'
}

try_all_claims
