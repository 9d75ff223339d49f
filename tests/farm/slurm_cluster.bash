#!/usr/bin/env bash
# A throw-away Slurm on this machine, for tests; to be sourced after farm_test.bash.
#
# munged, slurmctld and slurmd run as ordinary children of the test, under this user, on loopback and
# on ports that were free; all they write lies in $scratch/slurm. Neither systemd, cgroups nor a
# database is needed, nor anything under /etc. If the test is killed, the kernel ends the daemons too.

cluster=${scratch:?set by farm_test.bash}/slurm
slurm_nodes=3
export SLURM_CONF=$cluster/slurm.conf

skip_without_slurm() {
  local program
  for program in munged slurmctld slurmd sbatch scontrol; do
    PATH=$PATH:/usr/sbin:/sbin command -v "$program" >/dev/null || {
      echo "skipped: $program is not installed"
      exit 77
    }
  done
  PATH=$PATH:/usr/sbin:/sbin
}

# start_daemon NAME command...: in the background, with a log.
start_daemon() {
  local name=$1
  shift
  setpriv --pdeathsig KILL "${as_localhost[@]}" "$@" </dev/null >>"$cluster/log/$name.out" 2>&1 &
  daemons+=("$!")
}

# The daemons listen where the name of this host leads. If that is not loopback they get a host name
# of their own, if the kernel lets them; else they listen there, as munge protects them.
choose_address() {
  host=$(uname -n)
  host=${host%%.*}
  address=$(getent ahostsv4 "$host" | awk 'NR == 1 { print $1 }') || address=''
  as_localhost=()
  if [[ $address != 127.* ]]; then
    if unshare --uts true 2>/dev/null; then
      # shellcheck disable=SC2016 # expanded by the inner shell
      as_localhost=(unshare --uts sh -c 'hostname localhost && exec "$@"' sh)
      host=localhost address=127.0.0.1
    fi
  fi
  [[ -n $address ]] || fail "the host name $host leads nowhere; add it to /etc/hosts"
}

# Ports that nobody listens on; they are let go before the daemons take them, so that a collision is
# unlikely, not impossible.
free_ports() {
  python3 - "$1" <<'PY'
import socket, sys
held = [socket.socket() for _ in range(int(sys.argv[1]))]
for s in held:
    s.bind(("127.0.0.1", 0))
print(*(s.getsockname()[1] for s in held))
PY
}

write_slurm_conf() {
  local ports user k
  read -ra ports < <(free_ports $((slurm_nodes + 1)))
  user=$(id -un)
  cat >"$SLURM_CONF" <<CONF
ClusterName=test
SlurmctldHost=$host($address)
SlurmctldPort=${ports[0]}
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
# A requeued job waits for its credential to expire: 120 s by default, and at least 5.
AuthInfo=socket=$cluster/munge.socket,cred_expire=5
CredType=cred/munge
# Not on 0.0.0.0.
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
StateSaveLocation=$cluster/state
SlurmdSpoolDir=$cluster/spool.%n
SlurmctldPidFile=$cluster/slurmctld.pid
SlurmdPidFile=$cluster/slurmd.%n.pid
SlurmctldLogFile=$cluster/log/slurmctld.log
SlurmdLogFile=$cluster/log/slurmd.%n.log
PlugStackConfig=$cluster/plugstack.conf
MailProg=/bin/true
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
# A node may have fewer processors than it says.
SlurmdParameters=config_overrides
ReturnToService=2
JobRequeue=1
# As on most clusters, what no node can run is refused and does not wait for ever.
EnforcePartLimits=ALL
KillWait=10
MinJobAge=300
MaxArraySize=25
DependencyParameters=kill_invalid_depend
SchedulerParameters=sched_interval=1,batch_sched_delay=0,bf_interval=1
CONF
  for ((k = 1; k <= slurm_nodes; ++k)); do
    echo "NodeName=node$k NodeHostname=$host NodeAddr=$address Port=${ports[k]} CPUs=1 RealMemory=1000"
  done >>"$SLURM_CONF"
  echo "PartitionName=test Nodes=ALL Default=YES MaxTime=INFINITE State=UP" >>"$SLURM_CONF"
  : >"$cluster/plugstack.conf"
  # No cgroup is used, but slurmd looks which kind there is and ends where none is mounted, as in a bare
  # chroot; told the kind, it does not look.
  echo "CgroupPlugin=cgroup/v1" >"$cluster/cgroup.conf"
}

munge_answers() { munge -n -S "$cluster/munge.socket" | unmunge -S "$cluster/munge.socket"; }
controller_answers() { timeout 5 scontrol ping 2>/dev/null | grep -q 'is UP'; }
nodes_idle() { [[ $(timeout 5 sinfo -h -N -o %t | grep -c '^idle$') == "$slurm_nodes" ]]; }

declare -A slurmd_of=()
slurm_up() {
  local k
  daemons=()
  mkdir -p "$cluster"/{log,state}
  for ((k = 1; k <= slurm_nodes; ++k)); do mkdir -p "$cluster/spool.node$k"; done
  chmod 755 "$scratch" "$cluster"
  choose_address
  write_slurm_conf
  (umask 077 && head -c 128 /dev/urandom >"$cluster/munge.key")
  start_daemon munged munged --foreground --force --num-threads=1 --key-file="$cluster/munge.key" \
    --socket="$cluster/munge.socket" --pid-file="$cluster/munged.pid" \
    --log-file="$cluster/log/munged.log" --seed-file="$cluster/munged.seed"
  until_ok 10 munge_answers || slurm_failed "munged does not answer"
  start_daemon slurmctld slurmctld -D -c
  controller=${daemons[-1]}
  until_ok 20 controller_answers || slurm_failed "slurmctld does not answer"
  for ((k = 1; k <= slurm_nodes; ++k)); do start_node "node$k"; done
  until_ok 20 nodes_idle || slurm_failed "the nodes are not idle"
}

start_node() {
  start_daemon "slurmd.$1" slurmd -D -c -N "$1"
  slurmd_of[$1]=${daemons[-1]}
}

# The processes of the jobs on a node, and their slurmstepds.
on_node() {
  local pid
  for pid in $(marked); do
    grep -qzxF "SLURMD_NODENAME=$1" "/proc/$pid/environ" || continue
    echo "$pid"
  done 2>/dev/null
}
stepds_on_node() {
  local pid parent
  for pid in $(on_node "$1"); do
    parent=$(ps -o ppid= -p "$pid" | tr -d ' ')
    ! grep -qx slurmstepd "/proc/$parent/comm" || echo "$parent"
  done 2>/dev/null | sort -u
}

# The controller would notice by itself after SlurmdTimeout; it is told, so that no test waits for that.
declare_down() { scontrol update NodeName="$1" State=DOWN Reason=test; }

kill_node() {
  local pids
  mapfile -t pids < <(stepds_on_node "$1"; on_node "$1")
  kill -KILL "${slurmd_of[$1]}" "${pids[@]}" 2>/dev/null || true
  declare_down "$1"
}

# slurmd and slurmstepd stop, and what they started lives on.
freeze_node() {
  mapfile -t frozen < <(stepds_on_node "$1"; echo "${slurmd_of[$1]}")
  kill -STOP "${frozen[@]}"
  declare_down "$1"
}
thaw_node() { kill -CONT "${frozen[@]}" 2>/dev/null || true; }

# The controller saves its state some seconds after a change; what is newer goes with it.
restart_controller() {
  touch "$cluster/now"
  scontrol update JobId="$1" Comment=kept
  until_ok 30 test "$cluster/state/job_state" -nt "$cluster/now" || slurm_failed "no state is saved"
  kill -KILL "$controller"
  start_daemon slurmctld slurmctld -D
  controller=${daemons[-1]}
  until_ok 20 controller_answers || slurm_failed "slurmctld does not answer again"
}

slurm_failed() {
  tail -n 20 "$cluster"/log/* >&2
  fail "$*"
}

# Jobs first, then the daemons, then whatever is left of either.
slurm_down() {
  if controller_answers; then
    timeout 5 scancel --user="$(id -un)" || true
    until_ok 5 no_jobs || true
  fi
  if ((${#daemons[@]} > 0)); then
    kill "${daemons[@]}" 2>/dev/null || true
    until_ok 5 daemons_gone || true
  fi
  end_marked
}
no_jobs() { [[ -z $(timeout 5 squeue -h -t PD,R,CG) ]]; }
daemons_gone() { ! kill -0 "${daemons[@]}"; }

# ---- what is asked of jobs ----
over() { [[ -z $(squeue -h -t PD,R,CG,CF,RQ -j "$1") ]]; }
# Of each task of an array, a line: index, state, restarts.
tasks() { squeue -h -r -t all -j "$1" -O 'ArrayTaskID:8,State:16,RestartCnt:8' | tr -s ' ' | sort -n; }
logs_of() { tail -n 20 "$1"/farm/log/* "$1"/farm/*.log 2>/dev/null >&2 || true; }
wait_for() { # wait_for JOB FOLDER
  until_ok 300 over "$1" || {
    tasks "$1"
    logs_of "$2"
    fail "job $1 does not end"
  }
}
has_tasks() { # has_tasks JOB FOLDER line...
  [[ $(tasks "$1" | sed 's/ *$//') == "$(printf '%s\n' "${@:3}")" ]] || {
    tasks "$1" >&2
    logs_of "$2"
    fail "job $1 should read: ${*:3}"
  }
}
log_of() { echo "$1/farm/log/slurm_$2_$3.log"; } # log_of FOLDER JOB TASK
conclusion_says() { grep -qsF -e "$2" "$1"/farm/conclude_*.log; }
concluded() { # concluded FOLDER COUNT
  until_ok 90 conclusion_says "$1" "all $2 frames are there" || {
    logs_of "$1"
    squeue -t all >&2
    fail "$1 is not concluded"
  }
}

skip_without_slurm
trap 'slurm_down; umount "$scratch/small" 2>/dev/null || true; rm -rf "$scratch"' EXIT
slurm_up
pass "Slurm is up"
"$DOMEFALL" render fall.yaml --out single --threads 1 2>single.log
