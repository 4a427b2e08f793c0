#!/bin/sh
# resume_diagram.sh <shape_diagram> <scratch directory>: a diagram of which the last rows are missing is completed to the
# same rows (but for the seconds they took), those found from neighbouring cases included.
set -eu
program=$1
scratch=$2
rm -rf "$scratch"
mkdir -p "$scratch/resumed"
run() {
    "$program" --confinement 0.8:0.9:2 --reduced-volume 0.70:0.72:2 --out "$1" >/dev/null
}
# All columns but that of the seconds, the last but one.
rows() {
    sed 's/,[^,]*,\([^,]*\)$/,\1/' "$1/diagram.csv"
}
run "$scratch/whole"
grep -q ',neighbour,' "$scratch/whole/diagram.csv" || { echo "no state was found from a neighbouring case"; exit 1; }
cp "$scratch/whole/starts.txt" "$scratch/resumed"
grep -v '^[0-9.]*,0.72,' "$scratch/whole/diagram.csv" >"$scratch/resumed/diagram.csv"
run "$scratch/resumed"
rows "$scratch/whole" >"$scratch/whole.txt"
rows "$scratch/resumed" >"$scratch/resumed.txt"
cmp "$scratch/whole.txt" "$scratch/resumed.txt"
