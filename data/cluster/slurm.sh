#!/bin/bash
# Shares a study among the tasks of a Slurm job array: each task makes the blocks of its shard. These commands
# submit 32 tasks and, after them, the analysis; options of `cdpr study run` may follow, those of sbatch, such as
# --time=04:00:00, go before the script:
#
#   job=$(sbatch --parsable --array=1-32 \
#       data/cluster/slurm.sh 32 my-study.json results --observations 100000000)
#   sbatch --dependency=afterok:"$job" --wrap 'cdpr study merge results --table none'
#
# To repeat tasks, submit these with the same number of all; they keep the blocks that exist:
#
#   sbatch --array=7,9 data/cluster/slurm.sh 32 my-study.json results --observations 100000000
#SBATCH --job-name=cdpr
#SBATCH --cpus-per-task=16
#SBATCH --time=01:00:00
set -euo pipefail
usage='usage: sbatch --array=1-TASKS slurm.sh TASKS STUDY FOLDER [OPTIONS]'
tasks=${1:?$usage}
study=${2:?$usage}
folder=${3:?$usage}
srun cdpr study run "$study" --out "$folder" --shard "auto/$tasks" --threads "$SLURM_CPUS_PER_TASK" "${@:4}"
