#!/usr/bin/env bash
# Explores a problem in rounds: shares the sketches that wait among tasks of a Slurm array, waits for them, merges what
# came of them, and so on until nothing new comes.
#
#     examples/explore/rounds.sh PROBLEM STORE [TASKS]
#
# Without Slurm (no `sbatch` on this machine) the same tasks run here, JOBS of them at a time [default: one per
# processor]. KRAWL names the program, if it is not in the path.
set -euo pipefail

problem=$1 store=$2 tasks=${3:-4}
here=$(dirname "$0")
export KRAWL=${KRAWL:-krawl}

# What an array of tasks does, here.
run_here() {
    local last=$1
    seq 0 "$last" | xargs -P "${JOBS:-$(nproc)}" -I{} env SLURM_ARRAY_TASK_ID={} "$here/array.sh" "$store"
}

round=0
while true; do
    # Results of earlier rounds are in the store.
    rm -f "$store"/*.krawl-unit "$store"/*.krawl-result
    # One path at least, so that there is something to share; 0 means that nothing new comes any more.
    code=0
    "$KRAWL" explore "$problem" --store "$store" --take-back --paths 1 --quiet --all-time 0 || code=$?
    [ "$code" -eq 0 ] && break
    [ "$code" -eq 4 ] || exit "$code"
    "$KRAWL" explore "$problem" --store "$store" --paths 0 --shard "$tasks" --quiet --all-time 0 || [ $? -eq 4 ]
    units=$(find "$store" -name '*.krawl-unit' | wc -l)
    if [ "$units" -gt 0 ]; then
        round=$((round + 1))
        echo "round $round: $units work units"
        if command -v sbatch >/dev/null; then
            sbatch --wait --array="0-$((units - 1))" "$here/array.sh" "$store"
        else
            run_here "$((units - 1))"
        fi
        "$KRAWL" merge "$store" "$store"/*.krawl-result
    fi
done
"$KRAWL" explore "$problem" --store "$store" --paths 0
