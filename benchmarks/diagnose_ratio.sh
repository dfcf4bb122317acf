#!/usr/bin/env bash
# Time of `lacuna diagnose` by one binary over that by another one, on the same records in the same
# run, the two taking turns. Usage:
#   benchmarks/diagnose_ratio.sh OLD_BINARY NEW_BINARY FOLDER [RUNS]
# FOLDER holds cases as `study_hidden export` writes them (its folder `cases`): model.json, find.csv, check.csv.
# Prints the ratio of the medians for each case, and of the sums.
set -euo pipefail
old=$1 new=$2 folder=$3 runs=${4:-3}

seconds() {  # of the processor, user and system
  local self=$BASHPID before after
  before=$(awk '{print $16 + $17}' "/proc/$self/stat")
  "$1" diagnose --model "$2/model.json" "$2/find.csv" --holdout "$2/check.csv" --threads 1 \
    --json - >/dev/null || true
  after=$(awk '{print $16 + $17}' "/proc/$self/stat")
  echo $((after - before))
}
median() { sort -n | awk '{x[NR] = $1} END {print x[int((NR + 1) / 2)]}'; }

sum_old=0 sum_new=0
for place in "$folder"/*/; do
  a=() b=()
  for _ in $(seq "$runs"); do
    a+=("$(seconds "$old" "${place%/}")")
    b+=("$(seconds "$new" "${place%/}")")
  done
  x=$(printf '%s\n' "${a[@]}" | median) y=$(printf '%s\n' "${b[@]}" | median)
  sum_old=$((sum_old + x)) sum_new=$((sum_new + y))
  awk -v n="$(basename "$place")" -v x="$x" -v y="$y" \
    'BEGIN {printf "%-34s %6.2f s %6.2f s  ratio %.2f\n", n, x / 100, y / 100, y / (x > 0 ? x : 1)}'
done
awk -v x="$sum_old" -v y="$sum_new" 'BEGIN {printf "all: ratio %.3f\n", y / x}'
