#!/usr/bin/env bash
# Builds the unit tests of the folders that a change touches with the address and
# undefined-behaviour sanitizers (preset asan-ubsan) and runs them.
# Usage: scripts/sanitize_touched.sh [--list] [BASE]
#   --list  only tells which tests these are
#   BASE    what the change is against: a commit, default origin/main; what is not committed counts
set -euo pipefail
cd "$(dirname "$0")/.."
list=false
if [ "${1:-}" = --list ]; then list=true; shift; fi
base=${1:-origin/main}

# Folders with sources or unit tests that were changed: "model" of src/model/equations/term.cpp, of
# include/lacuna/model/equations/term.hpp and of tests/unit/model/equations/term_test.cpp.
touched_folders() {
  { git diff --name-only "$(git merge-base "$base" HEAD)"; git ls-files -o --exclude-standard; } |
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

mapfile -t tests < <(touched_folders | while IFS= read -r folder; do test_of "$folder"; done | sort -u)
if [ ${#tests[@]} -eq 0 ]; then echo "no unit tests of what was changed since $base"; exit 0; fi
echo "${tests[*]}"
if $list; then exit 0; fi

scripts/setup.sh tests clang
cmake --preset asan-ubsan > /dev/null
cmake --build --preset asan-ubsan --target "${tests[@]}"
failed=()
for test in "${tests[@]}"; do
  "build/asan-ubsan/tests/$test" --gtest_brief=1 || failed+=("$test")
done
[ ${#failed[@]} -eq 0 ] || { echo "failed: ${failed[*]}" >&2; exit 1; }
