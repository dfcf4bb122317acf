#!/usr/bin/env bash
# Builds the wheel of the Python package, installs it into a fresh virtual environment and runs its
# tests there, types, style and notebooks among them.
# Usage: scripts/python.sh [--sanitized] [BUILD]
#   --sanitized  library and extension under clang's address sanitizer; a report is a failure
#   BUILD        a folder in which the library was built already as a shared one (build/variant), which
#                the extension then uses; default: a build of its own below build/python
#   PYTHON       in the environment: interpreters, 3.10 or later, in order; default python3. Each runs
#                the tests with the wheel of the one before where that is for it too, else with its own
set -euo pipefail
cd "$(dirname "$0")/.."
build=build/python/cmake settings=() tests=(python/tests) environment=()
fresh=build/python/fresh wheels=build/python/wheels
if [ "${1:-}" = --sanitized ]; then
  shift
  build=build/python/sanitized
  settings=(cmake.define.CMAKE_CXX_COMPILER=clang++ cmake.define.LACUNA_SANITIZE=address
    cmake.build-type=RelWithDebInfo cmake.define.CMAKE_EXE_LINKER_FLAGS=-shared-libasan
    'cmake.define.CMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -gline-tables-only')
  tests=(-m 'not unsanitized' python/tests)
  # The library of C++ too: the sanitizer looks for what throws when the process begins.
  libraries="$(clang++ -print-file-name=libclang_rt.asan-x86_64.so) $(clang++ -print-file-name=libstdc++.so)"
  environment=(LD_PRELOAD="$libraries" ASAN_OPTIONS=detect_leaks=0 PYTHONMALLOC=malloc)
fi
build=${1:-$build}

# make_wheel PYTHON: what builds a wheel stays, so that what was built before is known to it.
make_wheel() {
  local tools
  tools=build/python/tools-$("$1" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
  [ -x "$tools/bin/pip" ] || "$1" -m venv "$tools"
  "$tools/bin/pip" install -q 'scikit-build-core>=0.10' 'nanobind>=3.1'
  rm -rf "$wheels"
  "$tools/bin/pip" wheel . -q --no-deps --no-build-isolation -w "$wheels" \
    --config-settings=build-dir="$build" "${settings[@]/#/--config-settings=}"
  wheel=$(echo "$wheels"/lacuna-*.whl)
}

wheel=
for python in ${PYTHON:-python3}; do
  rm -rf "$fresh"
  "$python" -m venv "$fresh"
  if [ -z "$wheel" ] || ! "$fresh/bin/pip" install -q --no-deps "$wheel" 2> /dev/null; then
    make_wheel "$python"
  fi
  "$fresh/bin/pip" install -q "$wheel[test]"
  cmake --build "$build" --target lacuna-cli
  echo "python: $("$python" --version), $(basename "$wheel")"
  env LACUNA_COMMAND="$PWD/$build/lacuna" "${environment[@]}" \
    "$fresh/bin/python" -m pytest "${tests[@]}"
done
