#!/usr/bin/env bash
# Looks at the lines that were changed since a commit: their format (.clang-format) and what clang-tidy
# has against them (.clang-tidy). Usage: scripts/style.sh COMMIT
set -euo pipefail
cd "$(dirname "$0")/.."
since=${1:?a commit}
scripts/setup.sh tests style
changes=$(git clang-format --diff --extensions cpp,hpp "$since" | grep -vE '^(no modified|clang-format did not)' || true)
if [ -n "$changes" ]; then
  echo "$changes"
  echo "style: format the lines above: git clang-format $since" >&2
  exit 1
fi
# Every source by itself, without what is of another compiler: the precompiled header, and options
# which clang does not know, which would be errors.
cmake --preset dev -B build/tidy -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DLACUNA_WARNINGS_AS_ERRORS=OFF \
  > /dev/null
git diff -U0 "$since" -- src include solvers bases effects |
  clang-tidy-diff-14.py -p1 -path build/tidy -quiet -j "$(nproc)" > build/tidy/said.txt 2>&1 || true
if grep -E ': (warning|error): |^Error while processing' build/tidy/said.txt; then
  echo "style: clang-tidy is against the lines above, or cannot read a source: build/tidy/said.txt" >&2
  exit 1
fi
