#!/usr/bin/env bash
# Identification of one file on threads and on processes, medians of 5 runs that take turns, and
# whether all results are the same to the bit. Usage:
#   benchmarks/studies/scaling/ranks.sh BUILD_FOLDER FILE.npy [ARGUMENTS OF identify]
# Prints a table.
set -euo pipefail
build=$1
shift
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
job="mpirun --oversubscribe --bind-to none -n"

names=("1 thread" "2 threads" "3 threads" "4 threads" "2 processes" "4 processes")
calls=("$build/lacuna --threads 1" "$build/lacuna --threads 2" "$build/lacuna --threads 3"
  "$build/lacuna --threads 4" "$job 2 $build/lacuna-mpi --threads 2"
  "$job 4 $build/lacuna-mpi --threads 2")

run() {  # seconds of a call; its arguments stand behind the word identify
  local call=${calls[$1]} begin end
  shift
  begin=$(date +%s.%N)
  ${call%% --threads*} identify "$@" --threads "${call##* }" --json "$folder/now" >/dev/null
  end=$(date +%s.%N)
  cmp -s "$folder/now" "$folder/first" || { [ -e "$folder/first" ] && echo differs >>"$folder/bits"; }
  [ -e "$folder/first" ] || cp "$folder/now" "$folder/first"
  awk -v a="$begin" -v b="$end" 'BEGIN {print b - a}'
}

for _ in 1 2 3 4 5; do
  for i in "${!calls[@]}"; do run "$i" "$@" >>"$folder/$i"; done
done
echo "| | s | times 1 thread |"
echo "|---|---|---|"
one=$(sort -n "$folder/0" | sed -n 3p)
for i in "${!calls[@]}"; do
  now=$(sort -n "$folder/$i" | sed -n 3p)
  awk -v n="${names[$i]}" -v a="$one" -v b="$now" 'BEGIN {printf "| %s | %.2f | %.2f |\n", n, b, a / b}'
done
[ -e "$folder/bits" ] && echo "Results differ." || echo "All results are the same to the bit."
