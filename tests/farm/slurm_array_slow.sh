#!/usr/bin/env bash
# farm/render-slurm against a single run, on a real Slurm: the same bytes, whatever happens to tasks.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=farm_test.bash
source "$(dirname "${BASH_SOURCE[0]}")/farm_test.bash"
# shellcheck source-path=SCRIPTDIR source=slurm_cluster.bash
source "$(dirname "${BASH_SOURCE[0]}")/slurm_cluster.bash"
trap 'rm -rf "$scratch"' EXIT
skip_without_slurm
cd "$scratch"
write_show fall.yaml
trap 'slurm_down; rm -rf "$scratch"' EXIT
slurm_up
pass "Slurm is up"
"$DOMEFALL" render fall.yaml --out single --threads 1 2>single.log

launch=("$farm/render-slurm" fall.yaml --cpus 1)
over() { [[ -z $(squeue -h -t PD,R,CG,CF,RQ -j "$1") ]]; }
# Of each task of an array, a line: index, state, restarts.
tasks() { squeue -h -r -t all -j "$1" -O 'ArrayTaskID:8,State:16,RestartCnt:8' | tr -s ' ' | sort -n; }
wait_for() { # wait_for JOB FOLDER
  until_ok 40 over "$1" || {
    tasks "$1"
    tail -n 20 "$2"/log/* >&2
    fail "job $1 does not end"
  }
}
has_tasks() { # has_tasks JOB FOLDER line...
  [[ $(tasks "$1" | sed 's/ *$//') == "$(printf '%s\n' "${@:3}")" ]] || {
    tasks "$1" >&2
    tail -n 20 "$2"/log/* >&2
    fail "job $1 should read: ${*:3}"
  }
}
says() { grep -qF -e "$2" "$1" || { cat "$1" >&2; fail "$1 does not say: $2"; }; }

# Writes a program whose worker on each of the two ranges stops itself at its third frame, once.
write_pausing_program() { # write_pausing_program NAME FOLDER
  cat >"$1" <<SCRIPT
#!/bin/bash
first=\$(sed -n 's/.* --frames \([0-9]*\)-.*/\1/p' <<<" \$*")
if [[ -n \$SLURM_JOB_ID && \$1 == render && ! -e $scratch/$1.\$first ]]; then
  touch "$scratch/$1.\$first"
  third=$scratch/$2/linear/fall_\$(printf %05d \$((first + 2))).exr
  (until [[ -e \$third || ! -e /proc/\$\$ ]]; do sleep 0.002; done; kill -STOP \$\$) &
  exec nice -n 19 $DOMEFALL "\$@"
fi
exec $DOMEFALL "\$@"
SCRIPT
  chmod +x "$1"
}
is_stopped() { [[ $(ps -o state= -p "$(workers "$1")") == T ]]; }
# SIGTERM waits for a stopped process.
is_told_to_end() { (($(sed -n 's/^ShdPnd:\t/0x/p' "/proc/$1/status") & 1 << 14)); }
both_stand() { is_stopped 0-19 && is_stopped 20-39; }

a_wrong_show_is_not_submitted() {
  local code=0
  sed 's/from_r: 4/from_r: -4/' fall.yaml >wrong.yaml
  "$farm/render-slurm" wrong.yaml --out wrong >wrong.log 2>&1 || code=$?
  [[ $code == 2 ]] || fail "a wrong show: exit code $code, not 2"
  says wrong.log "wrong.yaml:9:"
  [[ -z $(squeue -h -t all) ]] || fail "a wrong show was submitted"
  [[ ! -e wrong ]] || fail "a wrong show left a folder"
}

more_tasks_than_slurm_allows_are_refused() {
  local code=0
  "${launch[@]}" --out many --chunk 1 >many.log 2>&1 || code=$?
  [[ $code == 2 ]] || fail "40 tasks where 25 are allowed: exit code $code, not 2"
  says many.log "--chunk 2 or more fits"
  [[ -z $(squeue -h -t all) ]] || fail "it was submitted"
}

what_is_anothers_is_refused_before_it_is_submitted() {
  local code=0
  "${launch[@]}" --out single --size 32 >others.log 2>&1 || code=$?
  [[ $code == 2 ]] || fail "frames of another size: exit code $code, not 2"
  says others.log "single: 40 good frames of another size, show or kind would be replaced"
  [[ -z $(squeue -h -t all) ]] || fail "it was submitted"
  "${launch[@]}" --out wrong_size --size 5 >size.log 2>&1 || code=$?
  [[ $code == 2 && ! -e wrong_size ]] || fail "a wrong size was submitted"
}

# In two parts, so that the other array runs while this one waits for its second try.
begin_torn() {
  local worker
  write_pausing_program pausing torn
  torn=$(DOMEFALL=./pausing "${launch[@]}" --out torn --chunk 20)
  after=$(sbatch --parsable --output=/dev/null --dependency="afterok:$torn" \
    --wrap "touch $scratch/after.done")
  until_ok 20 both_stand || fail "no two tasks at work"
  made torn >torn.made
  kill -KILL "$(workers 0-19)"
  # What Slurm sends where the time limit is near.
  worker=$(workers 20-39)
  scancel --batch --signal=USR1 "${torn}_1"
  until_ok 20 is_told_to_end "$worker" || fail "the worker is not told to end"
  kill -CONT "$worker"
}
a_killed_worker_and_a_short_time_limit_lose_nothing() {
  wait_for "$torn" torn
  has_tasks "$torn" torn "0 COMPLETED 1" "1 COMPLETED 1"
  says "torn/log/render_${torn}_0.log" "frames 0-19: killed by signal 9; back to the queue"
  says "torn/log/render_${torn}_1.log" "frames 20-39: the time limit is near; back to the queue"
  same_frames single torn 40 || fail "the frames differ"
  no_temporaries torn || fail "temporary files are left"
  still_made torn.made torn || fail "frames were made twice"
  # Requeueing by RequeueExit would have cancelled it.
  until_ok 20 test -e after.done || fail "job $after, which waits with afterok, did not run"
}

begin_full() {
  write_full_disk_program full space
  full=$(DOMEFALL=./full "${launch[@]}" --out full.d --frames 0-3 --chunk 4 --retries 1)
}
a_full_disk_is_tried_again_but_not_for_ever() {
  local log=full.d/log/render_${full}_0.log
  wait_for "$full" full.d
  has_tasks "$full" full.d "0 FAILED 1"
  says "$log" "frames 0-3: exit code 75; back to the queue (restart 1 of at most 1)"
  says "$log" "frames 0-3: exit code 75; given up after 1 restarts"
  [[ $(frames_in full.d) == 0 ]] || fail "frames on a full disk"
}

# A program that has another version on the nodes than where the show is submitted.
a_node_with_another_version_makes_nothing() {
  local job
  cat >elsewhere <<SCRIPT
#!/bin/bash
[[ -n \$SLURM_JOB_ID && \$1 == --version ]] && exec echo domefall 0.0.1
exec $DOMEFALL "\$@"
SCRIPT
  chmod +x elsewhere
  job=$(DOMEFALL=./elsewhere "${launch[@]}" --out other --retries 0)
  wait_for "$job" other
  says "other/log/render_${job}_0.log" "this node has domefall 0.0.1, not $("$DOMEFALL" --version)"
  [[ $(frames_in other) == 0 ]] || fail "frames of another version"
}

# The show vanishes between the look that the task takes at it and the worker's own.
a_show_that_vanishes_under_a_task_is_tried_again() {
  local job log
  mkdir lost
  cp fall.yaml lost/fall.yaml
  cat >losing <<SCRIPT
#!/bin/bash
if [[ -n \$SLURM_JOB_ID && \$1 == render && ! -e $scratch/lost.done ]]; then
  touch $scratch/lost.done
  mv $scratch/lost/fall.yaml $scratch/found.yaml
fi
exec $DOMEFALL "\$@"
SCRIPT
  chmod +x losing
  job=$(DOMEFALL=./losing "$farm/render-slurm" lost/fall.yaml --cpus 1 --out lost.d --frames 0-3)
  log=lost.d/log/render_${job}_0.log
  until_ok 40 grep -q "back to the queue" "$log" || fail "not tried again: $(cat "$log")"
  mv found.yaml lost/fall.yaml
  wait_for "$job" lost.d
  has_tasks "$job" lost.d "0 COMPLETED 1"
  says "$log" "fall.yaml: No such file or directory"
  says "$log" "this node does not see $scratch/lost/fall.yaml"
  same_frames single lost.d 4 || fail "the frames differ"
}

# Its tasks end at once, so that it is mostly idle and would be given every one of them again.
a_bad_node_is_left_out_and_the_others_go_on() {
  local job bad
  bad=$(sinfo -h -N -o %N | sort -u | head -1)
  write_full_disk_program narrow never
  cat >uneven <<SCRIPT
#!/bin/bash
[[ \$SLURMD_NODENAME != $bad || \$1 != render ]] || exec $scratch/narrow "\$@"
exec $DOMEFALL "\$@"
SCRIPT
  chmod +x uneven
  job=$(DOMEFALL=./uneven "${launch[@]}" --out uneven.d --frames 0-19 --chunk 5 --retries 1)
  wait_for "$job" uneven.d
  tasks "$job" >uneven.tasks
  [[ $(grep -c COMPLETED uneven.tasks) == 4 ]] || fail "$(cat uneven.tasks "uneven.d/log/"*)"
  grep -qE 'COMPLETED +1' uneven.tasks || fail "no task was given to the bad node"
  same_frames single uneven.d 20 || fail "the frames differ"
}

# The last task of an array has the job id of the array itself.
the_last_task_is_requeued_without_the_others() {
  local job
  cat >once <<SCRIPT
#!/bin/bash
if [[ \$1 == render && " \$* " == *" 20-39 "* && ! -e $scratch/once.done ]]; then
  until [[ -e $scratch/last.d/linear/fall_00002.exr ]]; do sleep 0.05; done
  touch $scratch/once.done
  exit 75
fi
exec $DOMEFALL "\$@"
SCRIPT
  chmod +x once
  job=$(DOMEFALL=./once "${launch[@]}" --out last.d --chunk 20)
  wait_for "$job" last.d
  has_tasks "$job" last.d "0 COMPLETED 0" "1 COMPLETED 1"
  same_frames single last.d 40 || fail "the frames differ"
}

a_dead_task_and_a_cancelled_one_are_made_up_for() {
  local job worker
  write_pausing_program dying dead
  job=$(DOMEFALL=./dying "${launch[@]}" --out dead --chunk 20)
  until_ok 20 both_stand || fail "no two tasks at work"
  worker=$(workers 0-19)
  kill -KILL "$(ps -o ppid= -p "$worker" | tr -d ' ')" "$worker"
  scancel "${job}_1"
  wait_for "$job" dead
  has_tasks "$job" dead "0 FAILED 0" "1 CANCELLED 0"
  (($(frames_in dead) < 40)) || fail "too late: all frames are made"
  made dead >dead.made
  "${launch[@]}" --out dead --chunk 20 --wait >rerun.log 2>&1 || fail "$(cat rerun.log)"
  says rerun.log "all 40 frames are there"
  same_frames single dead 40 || fail "the frames differ"
  still_made dead.made dead || fail "frames were made twice"
}

# A program that is given another size on the nodes than where the show is submitted.
a_wrong_input_on_a_node_stops_the_array() {
  local code=0 job
  cat >smaller <<SCRIPT
#!/bin/bash
[[ -n \$SLURM_JOB_ID && \$1 == render ]] && set -- "\$@" --size 5
exec $DOMEFALL "\$@"
SCRIPT
  chmod +x smaller
  DOMEFALL=./smaller "${launch[@]}" --out small --chunk 2 --wait >small.job 2>small.log || code=$?
  job=$(cat small.job)
  [[ $code == 2 ]] || fail "a wrong size: exit code $code, not 2"
  says small.log "missing: frames 0-39 (40 of 40)"
  [[ $(grep -cF -e "--size 5:" "small/log/render_${job}_0.log") == 3 ]] ||
    fail "not refused 3 times: $(cat "small/log/render_${job}_0.log")"
  tasks "$job" >small.tasks
  awk '$3 != 0' small.tasks | cmp - /dev/null || fail "a wrong input was tried again"
  # Those that ran when the first failed do too; the others never begin.
  (($(grep -c FAILED small.tasks) <= 2 * slurm_nodes)) || fail "$(cat small.tasks)"
  grep -q CANCELLED small.tasks || fail "$(cat small.tasks)"
}

a_wrong_show_is_not_submitted
pass a_wrong_show_is_not_submitted
more_tasks_than_slurm_allows_are_refused
pass more_tasks_than_slurm_allows_are_refused
what_is_anothers_is_refused_before_it_is_submitted
pass what_is_anothers_is_refused_before_it_is_submitted
begin_torn
begin_full
for claim in a_killed_worker_and_a_short_time_limit_lose_nothing \
  a_full_disk_is_tried_again_but_not_for_ever a_node_with_another_version_makes_nothing \
  a_show_that_vanishes_under_a_task_is_tried_again \
  the_last_task_is_requeued_without_the_others a_bad_node_is_left_out_and_the_others_go_on \
  a_dead_task_and_a_cancelled_one_are_made_up_for a_wrong_input_on_a_node_stops_the_array; do
  $claim
  pass "$claim"
done
