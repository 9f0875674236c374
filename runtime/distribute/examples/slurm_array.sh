#!/bin/sh
# A Slurm job array over the parts of a job folder; every task renders one part, and one that is requeued or run twice does no harm.
#
#   parts=$(stokes distribute scene.json -o out.exr --dir /shared/job --parts 64 --plan)
#   sbatch --array=0-$((parts - 1)) slurm_array.sh /shared/job
#   stokes status /shared/job | tail -n 1 | sh          # when it says that all parts are done: the merge
#
# `stokes` must be in PATH on every node, or named by STOKES; the folder and the scene must be seen by all nodes under the same name.
#SBATCH --job-name=stokes
#SBATCH --ntasks=1
#SBATCH --requeue
#SBATCH --signal=TERM@30
set -eu
exec "${STOKES:-stokes}" distribute --dir "$1" --unit "$SLURM_ARRAY_TASK_ID" --threads "${SLURM_CPUS_PER_TASK:-0}"
