#!/usr/bin/env bash
# Sets up, builds with warnings as errors and runs all tests.
# Usage: scripts/check.sh [PRESET]   (check, dev, variant, asan-ubsan, tsan; default check)
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-check}

case $preset in
  check | dev) scripts/setup.sh ;;
  *) scripts/setup.sh clang ;;
esac
cmake --preset "$preset"
cmake --build --preset "$preset"
ctest --preset "$preset" -j "$(nproc)"
