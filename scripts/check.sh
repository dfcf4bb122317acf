#!/usr/bin/env bash
# Sets up, builds with warnings as errors and runs all tests.
# Usage: scripts/check.sh [PRESET]   (dev, variant, asan-ubsan, tsan, coverage; default dev)
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-dev}

case $preset in
  dev | coverage) scripts/setup.sh ;;
  *) scripts/setup.sh clang ;;
esac
cmake --preset "$preset"
cmake --build --preset "$preset"
ctest --preset "$preset" -j "$(nproc)"
