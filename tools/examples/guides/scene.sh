#!/bin/sh
# A scene of plants: trees that stand already are kept, shrubs and herbs join them, only above the water.
#
# usage: scene.sh FOLDER
# Writes terrain.ply, trees.ply, plants.ply with a column class, and plants.usda with an instancer that
# has a prototype for each class.
set -eu
mkdir -p "$1"
cd "$1"

# Replace both by yours: a mesh, and the trees as samples of it or as points (*.csv with x,y,z,class).
geodisk shapes terrain:80 -o terrain.ply
geodisk sample terrain.ply --mask "z>0" -d 0.08 --method darts -n 40 --classes 1 -o trees.ply

# Classes: 0 trees, 1 shrubs, 2 herbs. A row has the distances of a class to all classes.
plants() {
    geodisk sample terrain.ply --mask "z>0" --existing trees.ply --seed 1 \
        --classes "0.08,0.05,0.02;0.05,0.05,0.02;0.02,0.02,0.015" "$@"
}
plants -o plants.ply
plants --frames=upright --up z -o plants.usda
geodisk verify terrain.ply plants.ply --mask "z>0"
