#!/usr/bin/env bash
# Jobs of domefall farm submit --engine slurm that are cancelled, and such as share a folder, on a real Slurm.
source "$(dirname "$0")/farm_test.bash"
source "$here/slurm_cluster.bash"
launch=("$DOMEFALL" farm submit --engine slurm fall.yaml --threads 1)

# A task is cancelled, another one goes on and is then killed with its runner, a frame is damaged: the
# second round makes what lacks and nothing else.
begin_dead() {
  write_program dead.p <<'SCRIPT'
  if on 0-19 && once dead0; then
    first 0-19 0-2
    printf x >>"$scratch/dead/linear/fall_00001.exr"
    # It ends later than the other one, by the clock's seconds, too.
    until scontrol show job "${SLURM_ARRAY_JOB_ID}_1" | grep -q JobState=CANCELLED; do sleep 0.1; done
    sleep 1.5
    kill -KILL "$PPID"
    sleep 20
  elif on 20-39 && once dead1; then
    first 20-39 20-22
    scancel "${SLURM_ARRAY_JOB_ID}_1"
    wait_for never
  fi
SCRIPT
  dead=$("${launch[@]}" --program ./dead.p --out dead --chunk 20)
}
a_dead_task_and_a_cancelled_one_are_made_up_for() {
  wait_for "$dead" dead
  has_tasks "$dead" dead "0 FAILED 0" "1 CANCELLED 0"
  concluded dead 40
  conclusion_says dead "round 1 of at most 2: frames 1,3-19,23-39 (35 of 40) are rendered again" ||
    fail "another second round: $(cat dead/farm/conclude_*.log)"
  # Slurm may run a job again that has ended.
  expect 0 again.log "$DOMEFALL" farm conclude dead --plan "$(plan_in dead)" --round 0
  says again.log "round 1 has been submitted already"
  same_frames single dead 40 || fail "the frames differ"
}

# Some tasks run, the others wait.
what_is_cancelled_as_a_whole_is_not_rendered_again() {
  local job
  write_program endless <<'SCRIPT'
  first 0-3 0
  wait_for never
SCRIPT
  job=$("${launch[@]}" --program ./endless --out cancelled --frames 0-39 --chunk 4 2>cancelled.log)
  grep -q "scancel $job [0-9]* ends both" cancelled.log || fail "$(cat cancelled.log)"
  until_ok 60 at_least cancelled 1 || fail "no frames"
  scancel "$job"
  until_ok 60 conclusion_says cancelled "job $job was cancelled" || fail "not told: $(squeue -t all)"
  [[ $(grep -c '"round": 1' cancelled/farm/plan_*.json) == 0 ]] || fail "another round was planned"
  # The same submission goes on.
  job=$("${launch[@]}" --out cancelled --frames 0-39 --chunk 20 2>/dev/null)
  concluded cancelled 40
  same_frames single cancelled 40 || fail "the frames differ"
}

# The tasks of the first are held while another submission comes and goes, and a third one is refused.
two_arrays_into_a_folder_make_their_own_frames() {
  local first
  first=$("${launch[@]}" --out both --frames 0-4 --chunk 1 --movie review -- --hold 2>first.log)
  "${launch[@]}" --out both --frames 5-7 --chunk 3 2>/dev/null
  concluded both 3
  expect 2 refused.log "${launch[@]}" --out both --frames 8-9 -- --partition=nosuch
  says refused.log nosuch
  [[ $(find both/farm -name 'plan_*' | wc -l) == 2 ]] || fail "the refused plan is kept"
  scontrol release "$first"
  # The job that verifies was held, too.
  scontrol release "$(sed -n 's/.*job \([0-9]*\) verifies.*/\1/p' first.log)"
  wait_for "$first" both
  concluded both 5
  same_frames single both 8 || fail "the frames differ"
  until_ok 60 test -s both/fall_review.mp4 || fail "no movie"
}

# A show and folders whose names sbatch could take for something else, submitted from an allocation of
# the user's own and with variables that sbatch, squeue and scontrol read.
names_and_variables_change_nothing() {
  local odd='--wrap=touch pwned,%A' out='a,b %j %%' job
  mkdir -- "./$odd"
  cp fall.yaml "./$odd/-x $odd.yaml"
  job=$(env SBATCH_ARRAY_INX=5-9 SBATCH_WAIT=1 SBATCH_EXPORT=NONE SBATCH_ERROR=lost SBATCH_DEBUG=1 \
    SBATCH_SIGNAL=KILL@300 SLURM_JOB_ID=4242 SLURM_ARRAY_JOB_ID=4242 SLURM_ARRAY_TASK_ID=3 \
    SLURM_RESTART_COUNT=9 SLURM_TIME_FORMAT=relative SQUEUE_STATES=PD SQUEUE_FORMAT=%j SCONTROL_ALL=1 \
    "$DOMEFALL" farm submit --engine slurm "./$odd/-x $odd.yaml" --threads 1 --retries 1 --out "$out" \
    --frames 0-3 --chunk 2 2>names.log) || fail "$(cat names.log)"
  [[ $job =~ ^[0-9]+$ ]] || fail "no job: $job"
  wait_for "$job" "$out"
  has_tasks "$job" "$out" "0 COMPLETED 0" "1 COMPLETED 0"
  concluded "$out" 4
  says "$(log_of "$out" "$job" 0)" "2 frames made"
  [[ -z $(find . -name pwned -o -name lost) ]] || fail "a name was run, or a variable obeyed"
}

# Each node of this Slurm has one processor.
too_many_processors_are_refused_with_the_option_that_helps() {
  expect 2 unfit.log "${launch[@]/%1/4}" --out unfit --frames 0-1
  says unfit.log "a task asks for 4 processors of a node; --threads asks for another number"
}

begin_dead
try_all_claims
