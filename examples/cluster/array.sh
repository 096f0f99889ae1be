#!/usr/bin/env bash
# A study as an array of Slurm tasks: sbatch --array=1-40 array.sh FOLDER 40 [ROWS]
# FOLDER as 'voussoir study plan' made it, on a file system that all nodes share; ROWS as 'voussoir study status' prints
# them. Each task does one of 40 shares of the missing rows.
#SBATCH --job-name=voussoir
#SBATCH --cpus-per-task=1
#SBATCH --requeue
#SBATCH --open-mode=append
set -euo pipefail
folder=$1 tasks=$2 rows=${3:-}
# exec: Slurm's signal reaches the program itself, which then keeps a checkpoint of each run under way
exec voussoir study run "$folder" --jobs "${SLURM_CPUS_PER_TASK:-1}" --chunk "$SLURM_ARRAY_TASK_ID/$tasks" ${rows:+--rows "$rows"}
