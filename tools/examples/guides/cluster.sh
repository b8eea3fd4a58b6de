#!/bin/sh
# A cluster on one machine: shards of a batch side by side, then one that finds nothing left to do.
#
# usage: cluster.sh FOLDER
# Writes meshes/, and their samples with a log of each shard to samples/.
set -eu
mkdir -p "$1"
cd "$1"

# Meshes; yours lie in a folder that all nodes see.
mkdir -p meshes
for shape in icosphere:3 torus-knot:12 folded-sheet:12 cube:8 terrain:40 plate:12; do
    geodisk shapes "$shape" -o "meshes/${shape%:*}.ply"
done

# What each node runs. Slurm numbers them: SLURM_ARRAY_TASK_ID of SLURM_ARRAY_TASK_COUNT.
run_shard() {
    geodisk batch meshes -o samples --count 300 --resume --quiet --shard "$1/$shards"
}

shards=3
for shard in 0 1 2; do
    run_shard "$shard" &
    running="${running:-} $!"
done
for process in $running; do
    wait "$process" || echo "a shard failed; what is left is done below" >&2
done

# All shards wrote to one folder, so nothing has to be merged. This does what is missing, if anything,
# and fails if that fails.
geodisk batch meshes -o samples --count 300 --resume --json all.json
