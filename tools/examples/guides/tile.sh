#!/bin/sh
# Blue noise in a box: a square of points that repeats without a seam, with its spectrum.
#
# usage: tile.sh FOLDER
# Writes tile.csv, points with 0 <= x, y < 1, and spectrum.csv, their power by frequency.
set -eu
mkdir -p "$1"
cd "$1"

# Exactly 1,000 points, at a distance that leaves room for a few more.
geodisk box --dim 2 --periodic --min-distance 0.0253 --method darts --count 1000 --seed 1 -o tile.csv

# No two are closer, around the edges neither, and there is little power at low frequencies.
geodisk verify tile.csv
geodisk spectrum tile.csv -o spectrum.csv
