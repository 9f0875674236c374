#!/bin/bash
# The example job array on a Slurm of one node, started here from Debian's slurm-wlm and munge; bits compared with one render's.
# Usage, as root: slurm.sh STOKES   (exit 77 without Slurm)
set -eu
command -v slurmctld >/dev/null && command -v munged >/dev/null || { echo "slurm: skipped: no slurm-wlm and munge"; exit 77; }
stokes=$(realpath "$1")
here=$(realpath "$(dirname "$0")")
scene=$here/../cli/small.json
script=$here/../../runtime/distribute/examples/slurm_array.sh
folder=$(mktemp -d)
chmod 755 "$folder"
pids=()

cleanup() {
  [ ${#pids[@]} -eq 0 ] || kill "${pids[@]}" 2>/dev/null || true
  wait 2>/dev/null || true
  rm -rf "$folder"
}
trap cleanup EXIT

mkdir -p "$folder/state" "$folder/spool" "$folder/munge"
chmod 700 "$folder/munge"
head -c 1024 /dev/urandom >"$folder/munge/key"
chmod 400 "$folder/munge/key"
cat >"$folder/slurm.conf" <<END
ClusterName=stokes
SlurmctldHost=$(hostname -s)(127.0.0.1)
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket
CredType=cred/munge
SlurmUser=root
SlurmctldPort=16817
SlurmdPort=16818
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
ProctrackType=proctrack/pgid
TaskPlugin=task/none
MpiDefault=none
ReturnToService=2
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
NodeName=$(hostname -s) NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
export SLURM_CONF=$folder/slurm.conf
munged --foreground --force --key-file="$folder/munge/key" --socket="$folder/munge/socket" --pid-file="$folder/munge/pid" --log-file="$folder/munge/log" \
  --seed-file="$folder/munge/seed" &
pids+=($!)
for _ in $(seq 100); do [ -S "$folder/munge/socket" ] && break; sleep 0.1; done
slurmctld -D >"$folder/slurmctld.log" 2>&1 &
pids+=($!)
slurmd -D >"$folder/slurmd.log" 2>&1 &
pids+=($!)
for _ in $(seq 300); do [ "$(sinfo -h -o %t 2>/dev/null)" = idle ] && break; sleep 0.2; done
sinfo -h -o '%n: %t, %c CPUs'

cd "$folder"
parts=$("$stokes" distribute "$scene" --device reference -q --spp 800 -o out.exr --dir job --parts 6 --plan)
export STOKES=$stokes
sbatch --wait --array=0-$((parts - 1)) --output="$folder/task-%a.log" "$script" "$folder/job" || { tail -n 5 task-*.log slurm*.log; exit 1; }
# A task that is run again finds its part done.
sbatch --wait --array=2 --output="$folder/again.log" "$script" "$folder/job"
"$stokes" status job >script
sh script
"$stokes" render "$scene" --device reference -q --spp 800 -o whole.exr >/dev/null
"$stokes" compare whole.exr out.exr --exact >/dev/null
echo "slurm: an array of $parts tasks merged to the bits of one render"
