#!/usr/bin/env bash
# A Slurm of two nodes on this machine, without root's services: `start FOLDER`, `stop FOLDER`.
# Exit code 77: Slurm is not installed (Debian: slurm-wlm munge).
set -euo pipefail
PATH="$PATH:/usr/sbin:/sbin"
what=$1
R=$2
export SLURM_CONF="$R/slurm.conf"

stop() {
  for pid in "$R"/d-b.pid "$R"/d-a.pid "$R"/c.pid "$R"/munge/pid; do
    [ -s "$pid" ] && kill "$(cat "$pid")" 2>/dev/null || true
  done
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
    idle=$(sinfo -h -t idle -o %D 2>/dev/null || true)
    [ "$idle" = 2 ] && return 0
    sleep 0.2
  done
  echo "the nodes did not come up" >&2
  tail -n 5 "$R"/log/*.log >&2
  stop
  return 1
}

"$what"
