#!/bin/bash
# one_node_slurm.sh FOLDER COMMAND...
#
# Starts a Slurm of one node on this machine's loopback, all of its files in FOLDER (new, short
# path: a socket lies in it), carries out COMMAND with it, waits until its queue is empty and stops
# it. Nothing of an installed Slurm's own configuration is read or touched. Ends with COMMAND's code,
# or with 99 if Slurm did not come up.
set -u
PATH=$PATH:/usr/sbin:/sbin  # where daemons lie
folder=$1
shift
readonly ready_within_s=60 done_within_s=180
readonly node=$(hostname -s)
mkdir -p "$folder"/{state,spool}
chmod 755 "$folder"

free_port() {
  local port
  for port in $(shuf -i 20000-40000 -n 50); do
    (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null || { echo "$port"; return; }
  done
}

(umask 077; head -c 1024 /dev/urandom > "$folder/munge.key")
cat > "$folder/slurm.conf" <<END
ClusterName=vitruvia_test
SlurmctldHost=$node(127.0.0.1)
SlurmctldPort=$(free_port)
SlurmdPort=$(free_port)
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
ReturnToService=2
NodeName=$node NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=main Nodes=$node Default=YES State=UP
END
export SLURM_CONF="$folder/slurm.conf"

daemons=()
start() {
  "$@" > "$folder/$(basename "$1").out" 2>&1 &
  daemons+=($!)
}
stop() {
  local i
  for ((i = ${#daemons[@]} - 1; i >= 0; --i)); do
    kill "${daemons[i]}" 2>/dev/null
    wait "${daemons[i]}" 2>/dev/null
  done
}
trap stop EXIT

# Waits until the rest of the line succeeds, $1 seconds at the most.
await() {
  local end=$((SECONDS + $1))
  shift
  until "$@"; do
    ((SECONDS < end)) || return 1
    sleep 0.2
  done
}
node_is_idle() { [ "$(sinfo -h -o %T 2>/dev/null)" = idle ]; }
queue_is_empty() { [ -z "$(squeue -h 2>&1)" ]; }

start munged --foreground --force --key-file="$folder/munge.key" --socket="$folder/munge.socket" \
  --pid-file="$folder/munged.pid" --log-file="$folder/munged.log" --seed-file="$folder/munge.seed"
await "$ready_within_s" test -S "$folder/munge.socket" || { echo "munged did not start" >&2; exit 99; }
start slurmctld -D -f "$SLURM_CONF"
start slurmd -D -f "$SLURM_CONF" -N "$node"
await "$ready_within_s" node_is_idle || {
  echo "Slurm did not come up within $ready_within_s s; see $folder/*.log" >&2
  exit 99
}
"$@"
code=$?
await "$done_within_s" queue_is_empty || echo "jobs are still going on" >&2
exit $code
