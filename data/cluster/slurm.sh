#!/bin/bash
# A study shared by the tasks of a Slurm job array: each makes the blocks of its shard. To submit it and, when all
# tasks are done, its analysis (options of `cdpr study run` may follow; those of sbatch, such as --array=1-100, go before the script):
#
#   job=$(sbatch --parsable data/cluster/slurm.sh my-study.json results --observations 100000000)
#   sbatch --dependency=afterok:"$job" --wrap 'cdpr study merge results --table none'
#
# A task that ran out of time is submitted again as it was: it goes on.
#SBATCH --job-name=cdpr
#SBATCH --array=1-32
#SBATCH --cpus-per-task=16
#SBATCH --time=01:00:00
set -euo pipefail
study=${1:?usage: slurm.sh STUDY FOLDER [OPTIONS]}
folder=${2:?usage: slurm.sh STUDY FOLDER [OPTIONS]}
srun cdpr study run "$study" --out "$folder" --shard auto --threads "$SLURM_CPUS_PER_TASK" "${@:3}"
