#!/usr/bin/env bash
# Sets up, builds with warnings as errors and runs all tests; prints the time of each step and
# executable, and which tests were skipped.
# Usage: scripts/check.sh [--none-skipped] [--since COMMIT] [PRESET|full]
#   PRESET          check, dev, variant, asan-ubsan, tsan; default check
#   full            check, variant, both sanitizers and the Python package in turn: hours
#   --none-skipped  a skipped test is a failure
#   --since COMMIT  the library, and unit tests of folders that changed since then; what is not
#                   committed counts
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/core_seconds.sh
none_skipped=false since=
while [ $# -gt 0 ]; do
  case $1 in
    --none-skipped) none_skipped=true; shift ;;
    --since) since=$2; shift 2 ;;
    *) break ;;
  esac
done
preset=${1:-check}
if [ "$preset" = full ]; then
  for one in check variant asan-ubsan tsan; do scripts/check.sh "$one"; done
  exec scripts/python.sh build/variant
fi

# step NAME COMMAND...: says how long it took.
step() {
  local begin=$SECONDS spent
  spent=$(core_seconds)
  "${@:2}"
  echo "check: $preset: $1 in $((SECONDS - begin)) s, $(($(core_seconds) - spent)) s of a core"
}

# Folders with sources or unit tests that were changed: "model/equations" of src/model/equations/term.cpp,
# of include/lacuna/model/equations/term.hpp and of tests/unit/model/equations/term_test.cpp.
touched_folders() {
  { git diff --name-only "$(git merge-base "$since" HEAD)"; git ls-files -o --exclude-standard; } |
    grep -E '\.(cpp|hpp)$' |
    grep -E '^(src|include/lacuna|tests/unit|bases|effects|solvers)/' |
    sed -E 's,^(src|include/lacuna|tests/unit)/,,; s,/[^/]*$,,' | sort -u
}

# The executable of the folder, or of the nearest one above it that has one.
test_of() {
  local folder=$1
  while [ ! -d "tests/unit/$folder" ] || ! compgen -G "tests/unit/$folder/*_test.cpp" > /dev/null; do
    [ "$folder" != "${folder%/*}" ] || return 0
    folder=${folder%/*}
  done
  echo "unit_${folder//\//_}"
}

# Builds and runs what --since asks for.
check_touched() {
  local test failed=() tests
  mapfile -t tests < <(touched_folders | while IFS= read -r folder; do test_of "$folder"; done | sort -u)
  echo "check: $preset: changed since $since: ${tests[*]:-nothing}"
  step built cmake --build --preset "$preset" --target lacuna-cli "${tests[@]}"
  for test in "${tests[@]}"; do
    "build/$preset/tests/$test" --gtest_brief=1 || failed+=("$test")
  done
  [ ${#failed[@]} -eq 0 ] || { echo "check: failed: ${failed[*]}" >&2; exit 1; }
}

case $preset in
  check | dev) step "set up" scripts/setup.sh check ;;
  *) step "set up" scripts/setup.sh check clang ;;
esac
cmake --preset "$preset"
if [ -n "$since" ]; then check_touched; exit 0; fi
step built cmake --build --preset "$preset"
results=build/$preset/test_results
rm -rf "$results"
step tested ctest --preset "$preset" -j "$(nproc)"
if scripts/tests_run.py "$results" || ! $none_skipped; then exit 0; fi
echo "check: every test has to run here; scripts/setup.sh check installs what they need" >&2
exit 1
