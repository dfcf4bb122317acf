#!/usr/bin/env bash
# Runs every fuzz target for so many minutes (default 1), one after the other.
# Usage: scripts/fuzz.sh [MINUTES [SEED]]
# With clang++ they are built with libFuzzer and sanitizers into build/fuzz, elsewhere the targets of
# build/dev are driven by random changes of their seeds.
set -euo pipefail
cd "$(dirname "$0")/.."
minutes=${1:-1} seed=${2:-1}
seconds=$(awk "BEGIN { printf \"%d\", 60 * $minutes }")
targets=(text gzip npy expression model configuration)
if command -v clang++ > /dev/null; then
  cmake -G Ninja -S . -B build/fuzz -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=RelWithDebInfo \
    -DLACUNA_BUILD_TESTS=ON -DLACUNA_SANITIZE=address,undefined > /dev/null
  ninja -C build/fuzz "${targets[@]/#/fuzz_}"
  for target in "${targets[@]}"; do
    mkdir -p "build/fuzz/corpus/$target"
    build/fuzz/tests/fuzz_"$target" -max_total_time="$seconds" -seed="$seed" -rss_limit_mb=2048 \
      "build/fuzz/corpus/$target"
  done
else
  cmake --preset dev > /dev/null
  ninja -C build/dev "${targets[@]/#/fuzz_}"
  for target in "${targets[@]}"; do
    echo -n "$target: "
    build/dev/tests/fuzz_"$target" "$seconds" "$seed"
  done
fi
