#!/usr/bin/env bash
# Sets up, builds with warnings as errors and runs all tests; prints the time of each executable
# and which tests were skipped.
# Usage: scripts/check.sh [--none-skipped] [PRESET]
#   PRESET          check, dev, variant, asan-ubsan, tsan; default check
#   --none-skipped  a skipped test is a failure
set -euo pipefail
cd "$(dirname "$0")/.."
none_skipped=false
if [ "${1:-}" = --none-skipped ]; then none_skipped=true; shift; fi
preset=${1:-check}

case $preset in
  check | dev) scripts/setup.sh check ;;
  *) scripts/setup.sh check clang ;;
esac
cmake --preset "$preset"
cmake --build --preset "$preset"
results=build/$preset/test_results
rm -rf "$results"
ctest --preset "$preset" -j "$(nproc)"
if scripts/tests_run.py "$results" || ! $none_skipped; then exit 0; fi
echo "check: every test has to run here; scripts/setup.sh check installs what they need" >&2
exit 1
