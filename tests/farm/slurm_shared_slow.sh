#!/usr/bin/env bash
# Jobs of domefall farm submit --engine slurm that are cancelled, and such as share a folder, on a real Slurm.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=farm_test.bash
source "$(dirname "${BASH_SOURCE[0]}")/farm_test.bash"
# shellcheck source-path=SCRIPTDIR source=slurm_cluster.bash
source "$(dirname "${BASH_SOURCE[0]}")/slurm_cluster.bash"
# shellcheck source-path=SCRIPTDIR source=farm_submit.bash
source "$(dirname "${BASH_SOURCE[0]}")/farm_submit.bash"
trap 'rm -rf "$scratch"' EXIT
skip_without_slurm
cd "$scratch"
write_show fall.yaml
trap 'slurm_down; rm -rf "$scratch"' EXIT
slurm_up
pass "Slurm is up"
"$DOMEFALL" render fall.yaml --out single --threads 1 2>single.log

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

begin_dead
for claim in a_dead_task_and_a_cancelled_one_are_made_up_for \
  what_is_cancelled_as_a_whole_is_not_rendered_again \
  two_arrays_into_a_folder_make_their_own_frames; do
  $claim
  pass "$claim"
done
