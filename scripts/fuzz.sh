#!/usr/bin/env bash
# Runs every fuzz target for so many minutes of time (default 1), as many at once as there are cores.
# Usage: scripts/fuzz.sh [MINUTES [SEED [TARGET...]]]
# With clang++ they are built with libFuzzer and sanitizers into build/fuzz, elsewhere the targets of
# build/dev are driven by random changes of their seeds. Prints inputs, seconds and seconds of a core.
set -euo pipefail
cd "$(dirname "$0")/.."
minutes=${1:-1} seed=${2:-1}
targets=("${@:3}")
[ ${#targets[@]} -gt 0 ] || targets=(text gzip npy expression model configuration answers)
seconds=$(awk "BEGIN { printf \"%d\", 60 * $minutes }")
preset=dev
command -v clang++ > /dev/null && preset=fuzz
cmake --preset "$preset" > /dev/null
ninja -C "build/$preset" "${targets[@]/#/fuzz_}"

# A folder of inputs that reached something new, from which the next run goes on; the log tells the
# rest. An input that takes 20 s of a core (driver.cpp), 10 minutes or 2 GB is a finding.
run_target() {
  local folder=build/$preset/fuzz
  mkdir -p "$folder/$1"
  local arguments=("$seconds" "$seed")
  [ "$preset" = dev ] || arguments=(-max_total_time="$seconds" -seed="$seed" -timeout=600
    -rss_limit_mb=2048 -print_final_stats=1 -artifact_prefix="$folder/$1-" "$folder/$1")
  local TIMEFORMAT="%0R s, %0U s of a core" taken status=0
  taken=$({ time "build/$preset/tests/fuzz_$1" "${arguments[@]}" > "$folder/$1.log" 2>&1; } 2>&1) ||
    status=$?
  echo "$1: $(sed -nE 's/^stat::number_of_executed_units: *//p; s/ inputs$//p' "$folder/$1.log")" \
    "inputs, $taken, status $status"
  [ "$status" -eq 0 ] || tail -40 "$folder/$1.log"
  return "$status"
}
export -f run_target
export preset seconds seed
printf '%s\n' "${targets[@]}" | xargs -P "$(nproc)" -I '{}' bash -c 'run_target {}'
