#!/bin/bash
# Shares a study among the tasks of a HyperQueue task array and analyses it when all are done; options of
# `cdpr study run` may follow:
#
#   data/cluster/hyperqueue.sh 32 16 my-study.json results --observations 100000000
#
# runs 32 tasks on 16 cores each. After an interruption, the same command goes on.
set -euo pipefail
usage='usage: hyperqueue.sh TASKS CORES STUDY FOLDER [OPTIONS]'
tasks=${1:?$usage}
cores=${2:?$usage}
study=${3:?$usage}
folder=${4:?$usage}
hq submit --name cdpr --wait --array "1-$tasks" --cpus "$cores" -- \
  cdpr study run "$study" --out "$folder" --shard "auto/$tasks" --threads "$cores" "${@:5}"
cdpr study merge "$folder" --table none
