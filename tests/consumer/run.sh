#!/usr/bin/env bash
# Installs lacuna into a folder of its own, builds the consumer against the package, runs it.
# Usage: run.sh BUILD_DIRECTORY WORK_DIRECTORY CXX_COMPILER
set -euo pipefail
build=$1 work=$2 compiler=$3
source=$(cd "$(dirname "$0")" && pwd)

rm -rf "$work"
cmake --install "$build" --prefix "$work/prefix" >/dev/null
cmake -G Ninja -S "$source" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix" \
  -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=Release >/dev/null
cmake --build "$work/build" >/dev/null
"$work/build/consumer" >"$work/answers"
"$work/build/own_parts" >"$work/own_answers"
"$work/build/from_c"
"$work/build/own_contract" --gtest_brief=1
grep -q 'dv/dt = -4\*q - 0.2\*v' "$work/answers"
grep -q 'coulomb-friction' "$work/answers"
grep -q 'dv/dt = -4\*x - 0.3\*v\*abs(v)' "$work/own_answers"
grep -q 'one-sided-spring' "$work/own_answers"
[ ! -e "$work/prefix/include/lacuna/core/base/text.hpp" ]  # what is internal is not installed
[ -f "$work"/prefix/share/doc/lacuna/LICENSE ] && [ -f "$work"/prefix/share/man/man1/lacuna.1 ]
LD_LIBRARY_PATH="$work/prefix/lib" "$work/prefix/bin/lacuna" --version
