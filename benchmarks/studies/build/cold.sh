#!/usr/bin/env bash
# Builds the program of a preset from nothing, without ccache, and prints what it took.
# Usage: benchmarks/studies/build/cold.sh PRESET [SOURCES]
#   SOURCES  a folder with the project, or with an older version of it; default this one
set -euo pipefail
. "$(dirname "$0")/../../../scripts/core_seconds.sh"
preset=$1
cd "${2:-$(dirname "$0")/../../..}"
build=$(mktemp -d)
trap 'rm -rf "$build"' EXIT
export CCACHE_DISABLE=1
cmake --preset "$preset" -B "$build" > /dev/null
begin=$SECONDS spent=$(core_seconds)
cmake --build "$build" --target lacuna-cli
echo "cold: preset $preset, program built in $((SECONDS - begin)) s, $(($(core_seconds) - spent)) s of a core"
