#!/usr/bin/env bash
# A Slurm of two nodes on this machine, without root's services: `start FOLDER`, `stop FOLDER`,
# `kill_node FOLDER NODE`, with NODE one of a and b.
# Exit code 77: Slurm is not installed (Debian: slurm-wlm munge).
set -euo pipefail
PATH="$PATH:/usr/sbin:/sbin"
what=$1
R=$2
export SLURM_CONF="$R/slurm.conf"

stop() {
  for pid in "$R"/d-b.pid "$R"/d-a.pid "$R"/c.pid "$R"/munge/pid; do
    if [ -s "$pid" ] && [ -d "/proc/$(cat "$pid")" ]; then kill "$(cat "$pid")"; fi
  done
}

is_alive() { [ -d "/proc/$1" ] && ! grep -q '^State:[[:space:]]*Z' "/proc/$1/status" 2>/dev/null; }

is_dead_soon() {
  for _ in $(seq 50); do
    if ! is_alive "$1"; then return 0; fi
    sleep 0.1
  done
  echo "process $1 does not die" >&2
  return 1
}

# As a power cut would: the node's daemon, then what keeps its jobs and would tell, then the jobs.
kill_node() {
  local keepers="" jobs="" pid parent
  for pid in $(cd /proc && echo [0-9]*); do
    { tr '\0' '\n' <"/proc/$pid/environ" | grep -qx "SLURMD_NODENAME=$1"; } 2>/dev/null || continue
    { tr '\0' '\n' <"/proc/$pid/environ" | grep -qxF "SLURM_CONF=$SLURM_CONF"; } 2>/dev/null || continue
    jobs="$jobs $pid"
    parent=$(awk '/^PPid:/ { print $2 }' "/proc/$pid/status" 2>/dev/null) || continue
    case "$(cat "/proc/$parent/comm" 2>/dev/null)" in slurmstepd*) keepers="$keepers $parent" ;; esac
  done
  echo "killing node $1: daemon $(cat "$R/d-$1.pid"), keepers$keepers, jobs$jobs"
  if [ -z "$jobs" ]; then
    echo "the node had no job" >&2
    return 1
  fi
  # The end of one may be the end of the next: what counts is that none is left.
  for pid in "$(cat "$R/d-$1.pid")" $keepers $jobs; do
    if is_alive "$pid"; then kill -9 "$pid" || is_dead_soon "$pid"; fi
  done
  for pid in "$(cat "$R/d-$1.pid")" $keepers $jobs; do is_dead_soon "$pid"; done
}

start() {
  for program in munged slurmctld slurmd sbatch sinfo; do
    command -v "$program" >/dev/null || exit 77
  done
  H=$(hostname -s)
  U=$(id -un)
  mkdir -p "$R/munge" "$R/state" "$R/log" "$R/spool-a" "$R/spool-b"
  chmod 711 "$R/munge"
  (umask 077 && head -c 128 /dev/urandom >"$R/munge/key")
  munged --force --key-file="$R/munge/key" --socket="$R/munge/sock" --pid-file="$R/munge/pid" \
    --log-file="$R/munge/log" --seed-file="$R/munge/seed"
  cat >"$R/cgroup.conf" <<CGROUP
CgroupPlugin=cgroup/v1
CGROUP
  port=$((20000 + RANDOM % 20000))
  cat >"$R/slurm.conf" <<CONF
ClusterName=prehensile
SlurmctldHost=$H(127.0.0.1)
SlurmctldPort=$port
SlurmUser=$U
SlurmdUser=$U
AuthType=auth/munge
AuthInfo=socket=$R/munge/sock
StateSaveLocation=$R/state
SlurmdSpoolDir=$R/spool-%n
SlurmctldPidFile=$R/c.pid
SlurmdPidFile=$R/d-%n.pid
SlurmctldLogFile=$R/log/c.log
SlurmdLogFile=$R/log/d-%n.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_min_interval=200000,bf_interval=1
SlurmdTimeout=10
ReturnToService=2
MinJobAge=3600
NodeName=a NodeHostname=$H NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=1 State=UNKNOWN
NodeName=b NodeHostname=$H NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=1 State=UNKNOWN
PartitionName=main Nodes=a,b Default=YES State=UP
CONF
  slurmctld
  slurmd -N a
  slurmd -N b
  for _ in $(seq 300); do
    if ! idle=$(sinfo -h -t idle -o %D 2>&1); then
      sleep 0.2  # the controller does not answer yet
      continue
    fi
    if [ "$idle" = 2 ]; then return 0; fi
    sleep 0.2
  done
  echo "the nodes did not come up; sinfo said: $idle" >&2
  tail -n 5 "$R"/log/*.log >&2
  stop
  return 1
}

"$what" "${@:3}"
