#!/usr/bin/env bash
# Sets up a fresh machine, builds lacuna, tells what a pendulum's model lacks, identifies the equations
# of the shipped circuit, and writes both answers as reports.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/core_seconds.sh

echo "demo: installs what is missing of a compiler and eleven libraries, builds build/demo/lacuna with
demo: the compiler that is there, and answers two questions: 3 minutes of two cores, and the download"
scripts/setup.sh
echo "demo: set up after $SECONDS s, $(core_seconds) s of a core"
cmake --preset demo > /dev/null
cmake --build --preset demo
echo "demo: built after $SECONDS s, $(core_seconds) s of a core"

out=build/demo/answers
mkdir -p "$out"
set -x
build/demo/lacuna diagnose --model data/pendulum.ode data/pendulum_scope_1.csv.gz \
  --holdout data/pendulum_scope_2.csv.gz --map th=CH1,w=CH2,u=CH3 --report "$out/pendulum.html"
build/demo/lacuna identify data/tl072_record.csv.gz \
  --model-out "$out/tl072_model.json" --json "$out/tl072_result.json" --report "$out/tl072.html"
{ set +x; } 2> /dev/null
echo "demo: answered after $SECONDS s, $(core_seconds) s of a core; reports in $out"
