#!/usr/bin/env bash
#SBATCH --job-name=krawl
#SBATCH --time=01:00:00
#SBATCH --cpus-per-task=4
#SBATCH --mem=2G
#
# One task of a Slurm array: works off one work unit of `krawl explore --shard`. A task that is killed goes on from the
# last path that was done when it is submitted again.
#
#     sbatch --array=0-99 examples/explore/array.sh STORE
#
# STORE is the folder of the store, on a file system that all nodes see. The task's number counts the units there.
set -euo pipefail

store=$1
krawl=${KRAWL:-krawl}
units=("$store"/*.krawl-unit)
unit=${units[$SLURM_ARRAY_TASK_ID]}

# 4 is no failure: the time ended before the unit did, and what is done can be merged.
"$krawl" work "$unit" --quiet --jobs "${SLURM_CPUS_PER_TASK:-1}" --time "${KRAWL_TASK_SECONDS:-3500}" || [ $? -eq 4 ]
