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

# Each page of the tutorial has its program to the byte, and what that prints. Pages are followed
# one behind the other in a folder with the shipped records, as in the root of the repository.
root=$(cd "$source/../.." && pwd)
block() { awk -v begin="\`\`\`$1" 'on && $0 == "```" {exit} on {print} $0 == begin {on = 1}' "$2"; }
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none
ln -s "$root/data" "$work/data"
[ "$(ls "$root/docs/tutorial")" = "$(cd "$root/examples" && ls -- *.cpp | sed 's/cpp$/md/')" ]
for page in "$root"/docs/tutorial/*.md; do
  name=$(basename "$page" .md)
  diff "$root/examples/$name.cpp" <(block cpp "$page")
  if [ -x "$work/build/examples/$name" ]; then
    block sh "$page" >"$work/commands"
    (cd "$work" && bash -eu commands >printed)
    diff "$work/printed" <(block text "$page")
  else
    echo "$name is not built: what it needs besides lacuna is not here"
  fi
done

[ ! -e "$work/prefix/include/lacuna/core/base/text.hpp" ]  # what is internal is not installed
[ -f "$work"/prefix/share/doc/lacuna/LICENSE ] && [ -f "$work"/prefix/share/man/man1/lacuna.1 ]
LD_LIBRARY_PATH="$work/prefix/lib" "$work/prefix/bin/lacuna" --version
