#!/usr/bin/env bash
# Builds the wheel of the Python package, installs it into a fresh virtual environment and runs its
# tests there, types, style and notebooks among them.
# Usage: scripts/python.sh [BUILD]
#   BUILD   a folder in which the library was built already as a shared one (build/variant), which the
#           extension then uses; default: a build of its own in build/python
#   PYTHON  in the environment: the interpreter, 3.10 or later; default python3
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build/python/cmake}
python=${PYTHON:-python3}
tools=build/python/tools fresh=build/python/fresh wheels=build/python/wheels

# What builds the wheel stays, so that what was built before is known to it.
[ -x $tools/bin/pip ] || "$python" -m venv $tools
$tools/bin/pip install -q 'scikit-build-core>=0.10' 'nanobind>=3.1'
rm -rf $fresh $wheels
$tools/bin/pip wheel . -q --no-deps --no-build-isolation -w $wheels --config-settings=build-dir="$build"
cmake --build "$build" --target lacuna-cli

"$python" -m venv $fresh
$fresh/bin/pip install -q "$(echo $wheels/lacuna-*.whl)[test]"
LACUNA_COMMAND=$PWD/$build/lacuna $fresh/bin/python -m pytest python/tests
