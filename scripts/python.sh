#!/usr/bin/env bash
# Builds the wheel of the Python package, installs it into a fresh virtual environment and runs its
# tests there, types, style and notebooks among them.
# Usage: scripts/python.sh [--sanitized] [BUILD]
#   --sanitized  the extension under address sanitizer; a report is a failure
#   BUILD        a folder in which the library was built already as a shared one (build/variant), which
#                the extension then uses; default: a build of its own below build/python
#   PYTHON       in the environment: interpreters, 3.10 or later, in order; default python3. Each runs
#                the tests with the wheel of the one before where that is for it too, else with its own
set -euo pipefail
cd "$(dirname "$0")/.."
sanitizer=
if [ "${1:-}" = --sanitized ]; then sanitizer=address; shift; fi
build=${1:-build/python/cmake}
fresh=build/python/fresh wheels=build/python/wheels
pythons=(${PYTHON:-python3})

# install ENVIRONMENT PACKAGE...: by uv, which is faster than pip.
install() { build/python/uv/bin/uv pip install -q --python "$1/bin/python" "${@:2}"; }
[ -x build/python/uv/bin/uv ] ||
  { "${pythons[0]}" -m venv build/python/uv && build/python/uv/bin/pip install -q uv; }

# make_wheel PYTHON: what builds a wheel stays, so that what was built before is known to it.
make_wheel() {
  local tools settings=(build-dir="$build" cmake.define.LACUNA_SANITIZE_EXTENSION=$sanitizer)
  # What makes the stubs imports the extension, without the sanitizer's library.
  [ -z "$sanitizer" ] || settings+=(build.targets=_lacuna)
  tools=build/python/tools-$("$1" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
  [ -x "$tools/bin/pip" ] || "$1" -m venv "$tools"
  install "$tools" 'scikit-build-core>=0.10' 'nanobind>=3.1'
  # The settings of a folder are forgotten where it says that other tools were there before.
  rm -rf $wheels "$build/.skbuild-info.json"
  "$tools/bin/pip" wheel . -q --no-deps --no-build-isolation -w $wheels \
    "${settings[@]/#/--config-settings=}"
  wheel=$(echo $wheels/lacuna_ode-*.whl)
}

# run_tests: under a sanitizer without what measures, or reads sources only. Its library has to be
# there before the process begins, and that of C++ with what throws.
run_tests() {
  local tests=(python/tests) environment=(LACUNA_COMMAND="$PWD/$build/lacuna")
  if [ -n "$sanitizer" ]; then
    local compiler runtime
    compiler=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt")
    runtime=$("$compiler" -print-file-name=libclang_rt.asan-x86_64.so)
    [ -f "$runtime" ] || runtime=$("$compiler" -print-file-name=libasan.so)
    runtime+=" $("$compiler" -print-file-name=libstdc++.so.6)"
    environment+=(LD_PRELOAD="$runtime" ASAN_OPTIONS=detect_leaks=0 PYTHONMALLOC=malloc)
    tests+=(-m 'not unsanitized')
  fi
  env "${environment[@]}" $fresh/bin/python -m pytest "${tests[@]}"
}

wheel=
for python in "${pythons[@]}"; do
  rm -rf $fresh
  "$python" -m venv $fresh
  if [ -z "$wheel" ] || ! install $fresh --no-deps "$wheel" 2> /dev/null; then
    make_wheel "$python"
  fi
  install $fresh "$wheel[test]"
  cmake --build "$build" --target lacuna-cli
  echo "python: $("$python" --version), $(basename "$wheel")"
  run_tests
done
