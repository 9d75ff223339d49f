#!/usr/bin/env bash
# domefall farm submit --engine slurm against a single run, on a real Slurm: the same bytes, whatever
# happens to tasks, nodes and the controller.
source "$(dirname "$0")/farm_test.bash"
source "$here/slurm_cluster.bash"
slurm_farm=("$DOMEFALL" farm submit --engine slurm)
launch=("${slurm_farm[@]}" fall.yaml --threads 1)
array=("${launch[@]}" --rounds 0)

a_wrong_show_is_not_submitted() {
  sed 's/from_r: 4/from_r: -4/' fall.yaml >wrong.yaml
  expect 2 wrong.log "${slurm_farm[@]}" wrong.yaml --out wrong
  says wrong.log "wrong.yaml:9:"
  [[ -z $(squeue -h -t all) ]] || fail "a wrong show was submitted"
  [[ ! -e wrong ]] || fail "a wrong show left a folder"
}

more_tasks_than_slurm_allows_are_refused() {
  expect 2 many.log "${launch[@]}" --out many --chunk 1
  says many.log "--chunk 2 or more fits"
  [[ -z $(squeue -h -t all) ]] || fail "it was submitted"
}

what_is_anothers_is_refused_before_it_is_submitted() {
  expect 2 others.log "${launch[@]}" --out single --size 32
  says others.log "single: 40 good frames of another size, show or kind would be replaced"
  expect 2 size.log "${launch[@]}" --out wrong_size --size 5
  expect 2 option.log "${launch[@]}" --out wrong_option -- --partition=nowhere
  says option.log "nowhere"
  [[ -z $(squeue -h -t all) && ! -e wrong_size ]] || fail "it was submitted"
}

a_dry_run_prints_what_is_submitted() {
  local job
  expect 0 dry.log "${array[@]}" --out "dry run" --chunk 20 --frames 0-3 --dry-run -- --nice=7 --comment='a b'
  [[ ! -e "dry run" ]] || fail "a dry run left a folder"
  # What it prints is for a shell; a plan, which the task reads, is there as after a submission.
  "$DOMEFALL" farm submit --engine list fall.yaml --out "dry run" --chunk 20 --frames 0-3 >dry.list
  job=$(head -1 dry.log | sed "s/PLAN/$(plan_in "dry run")/" | bash) || fail "$(cat dry.log)"
  scontrol show job -o "$job" >dry.job
  for word in "Nice=7" "Comment=a b"; do says dry.job "$word"; done
  wait_for "$job" "dry run"
  has_tasks "$job" "dry run" "0 COMPLETED 0"
  same_frames single "dry run" 4 || fail "the frames differ"
}

# Those that wait for the cluster are begun first, so that they wait side by side.
begin_torn() {
  write_program tearing <<'SCRIPT'
  if on 0-19 && once torn0; then
    first 0-19 0-2
    kill -KILL $$
  elif on 20-39 && once torn1; then
    first 20-39 20-22
    # What Slurm sends where the time limit is near.
    scancel --batch --signal=USR1 "${SLURM_ARRAY_JOB_ID}_1"
    wait_for never
  fi
SCRIPT
  torn=$("${launch[@]}" --program ./tearing --out torn --chunk 20 --movie review)
  after=$(sbatch --parsable --output=/dev/null --dependency="afterok:$torn" \
    --wrap "touch $scratch/after.done")
}
a_killed_worker_and_a_short_time_limit_lose_nothing() {
  wait_for "$torn" torn
  has_tasks "$torn" torn "0 COMPLETED 1" "1 COMPLETED 1"
  says "$(log_of torn "$torn" 0)" "frames 0-19: killed by SIGKILL; back to the queue (restart 1 of at most 3)"
  says "$(log_of torn "$torn" 1)" "frames 20-39: the time limit is near; back to the queue"
  concluded torn 40
  same_frames single torn 40 || fail "the frames differ"
  no_temporaries torn/linear || fail "temporary files are left"
  # Requeueing by RequeueExit would have cancelled it.
  until_ok 40 test -e after.done || fail "job $after, which waits with afterok, did not run"
  until_ok 60 test -s torn/fall_review.mp4 || fail "no movie: $(cat torn/farm/conclude_*.log)"
}

begin_full() {
  write_full_disk_program full space
  full=$("${array[@]}" --program ./full --out full.d --frames 0-3 --chunk 4 --retries 1)
}
a_full_disk_is_tried_again_but_not_for_ever() {
  local log
  log=$(log_of full.d "$full" 0)
  wait_for "$full" full.d
  has_tasks "$full" full.d "0 FAILED 1"
  says "$log" "back to the queue (restart 1 of at most 1)"
  says "$log" "given up after 1 restarts"
  grep -q "^node[0-9]: frames 0-3: exit code 75: .*fall_00000" "$log" || fail "no reason: $(cat "$log")"
  until_ok 60 conclusion_says full.d "frames 0-3 (4 of 4); the logs are in" || fail "not told what lacks"
}

# A small disk of its own, where that may be mounted. When it is full its logs cannot be written either.
begin_small() {
  small=''
  mkdir small
  mount -t tmpfs -o size=1m none small 2>/dev/null || return 0
  head -c 820000 /dev/zero >small/ballast
  small=$("${array[@]}" --out small/frames --frames 0-19 --chunk 20 --retries 100)
}
a_disk_that_fills_up_is_gone_on_with() {
  if [[ -z $small ]]; then
    echo "no tmpfs may be mounted here: not tried"
    return
  fi
  until_ok 60 restarted "$small" 0 || fail "the disk was not full: $(tasks "$small")"
  [[ $(frames_in small/frames) -gt 0 && $(frames_in small/frames) -lt 20 ]] ||
    fail "not full in the middle: $(frames_in small/frames) frames"
  made small/frames >small.made
  rm small/ballast
  mount -o remount,size=64m small
  wait_for "$small" small/frames
  [[ $(tasks "$small") == "0 COMPLETED "[1-9]* ]] || fail "$(tasks "$small")"
  same_frames single small/frames 20 || fail "the frames differ"
  still_made small.made small/frames || fail "frames were made twice"
}
restarted() { tasks "$1" | grep -qE "^$2 [A-Z]+ [1-9]"; }

# The plan says another version than that of the nodes: held jobs read it when they are let go.
a_node_with_another_version_makes_nothing() {
  local job
  job=$("${array[@]}" --out other --frames 0-3 --retries 0 -- --hold)
  sed -i 's/"domefall": "domefall .*"/"domefall": "domefall 0.0.0"/' other/farm/plan_*.json
  scontrol release "$job"
  wait_for "$job" other
  says "$(log_of other "$job" 0)" "this node has $("$DOMEFALL" --version), not domefall 0.0.0"
  [[ $(frames_in other) == 0 ]] || fail "frames of another version"
}

# The show vanishes between the look that the task takes at it and the worker's own.
begin_lost() {
  mkdir lost
  cp fall.yaml lost/fall.yaml
  write_program losing <<'SCRIPT'
  if once lost; then mv "$scratch/lost/fall.yaml" "$scratch/found.yaml"; fi
SCRIPT
  lost=$("${slurm_farm[@]}" lost/fall.yaml --threads 1 --rounds 0 --program ./losing --out lost.d --frames 0-3)
  until_ok 60 grep -qs "back to the queue" "$(log_of lost.d "$lost" 0)" || fail "not tried again"
  mv found.yaml lost/fall.yaml
}
a_show_that_vanishes_under_a_task_is_tried_again() {
  wait_for "$lost" lost.d
  has_tasks "$lost" lost.d "0 COMPLETED 1"
  says "$(log_of lost.d "$lost" 0)" "fall.yaml: No such file or directory"
  same_frames single lost.d 4 || fail "the frames differ"
}

# Its tasks end at once, so that it is mostly idle and would be given every one of them again. One node
# has a full disk; another one a damaged asset, so that a good show is refused there.
a_bad_node_is_left_out_and_the_others_go_on() {
  local job
  write_program uneven <<'SCRIPT'
  if [[ $SLURMD_NODENAME == node1 ]]; then trap '' XFSZ; ulimit -f 1; fi
  if [[ $SLURMD_NODENAME == node2 ]]; then set -- "$@" --size 5; fi
SCRIPT
  job=$("${array[@]}" --program ./uneven --out uneven.d --frames 0-19 --chunk 5 --retries 2)
  wait_for "$job" uneven.d
  tasks "$job" >uneven.tasks
  [[ $(grep -c COMPLETED uneven.tasks) == 4 ]] || fail "$(cat uneven.tasks uneven.d/farm/log/*)"
  grep -qE 'COMPLETED +[12]' uneven.tasks || fail "no task was given to the bad nodes"
  [[ $(cat uneven.d/farm/log/* | grep -c -e "--size 5:") -ge 3 ]] ||
    fail "no task was refused 3 times: $(cat uneven.d/farm/log/*)"
  same_frames single uneven.d 20 || fail "the frames differ"
}

# The last task of an array has the job id of the array itself.
begin_last() {
  write_program last_fails <<'SCRIPT'
  if on 20-39 && once last; then
    until [[ -e $scratch/last.d/linear/fall_00002.exr ]]; do sleep 0.05; done
    exit 75
  fi
SCRIPT
  last=$("${array[@]}" --program ./last_fails --out last.d --chunk 20)
}
the_last_task_is_requeued_without_the_others() {
  wait_for "$last" last.d
  has_tasks "$last" last.d "0 COMPLETED 0" "1 COMPLETED 1"
  same_frames single last.d 40 || fail "the frames differ"
}

# The controller dies and comes back. One node dies with all that runs on it, another one freezes: its task
# is begun again elsewhere while it lives and goes on, so that two write the same frames.
nodes_and_the_controller_may_go() {
  local job k node_of=()
  write_program surviving <<'SCRIPT'
  if on 0-13 && once survive0; then first 0-13 0-2; wait_for dead.never
  elif on 14-27 && once survive1; then
    first 14-27 14-16
    wait_for thaw
  fi
SCRIPT
  job=$("${launch[@]}" --program ./surviving --out lossy --frames 0-27 --chunk 14)
  until_ok 60 at_least lossy 6 || fail "no frames"
  for k in 0 1; do
    node_of[k]=$(squeue -h -r -t R -j "${job}_$k" -o %N)
  done
  # Both tasks wait, so that what the controller knows is on its disk when it dies.
  restart_controller "$job"
  kill_node "${node_of[0]}"
  freeze_node "${node_of[1]}"
  # The second try of the frozen node's chunk is the first that can end.
  until_ok 90 restarted "$job" 1 || fail "the frozen node's task is not begun again: $(tasks "$job")"
  touch thaw
  wait_for "$job" lossy
  concluded lossy 28
  thaw_node "${node_of[1]}"
  same_frames single lossy 28 || fail "the frames differ"
}

try_claims a_wrong_show_is_not_submitted more_tasks_than_slurm_allows_are_refused \
  what_is_anothers_is_refused_before_it_is_submitted
begin_torn
begin_full
begin_small
begin_lost
begin_last
try_claims a_dry_run_prints_what_is_submitted a_node_with_another_version_makes_nothing \
  a_killed_worker_and_a_short_time_limit_lose_nothing a_full_disk_is_tried_again_but_not_for_ever \
  a_disk_that_fills_up_is_gone_on_with a_show_that_vanishes_under_a_task_is_tried_again \
  the_last_task_is_requeued_without_the_others \
  a_bad_node_is_left_out_and_the_others_go_on \
  nodes_and_the_controller_may_go
