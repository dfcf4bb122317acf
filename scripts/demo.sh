#!/usr/bin/env bash
# Sets up a fresh machine, builds lacuna, tells what a pendulum's model lacks, identifies the equations
# of the shipped circuit, and writes both answers as reports.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh clang
cmake --preset demo
cmake --build --preset demo

out=build/demo/answers
mkdir -p "$out"
set -x
build/demo/lacuna diagnose --model data/pendulum.ode data/pendulum_scope_1.csv.gz \
  --holdout data/pendulum_scope_2.csv.gz --map th=CH1,w=CH2,u=CH3 --report "$out/pendulum.html"
build/demo/lacuna identify data/tl072_record.csv.gz \
  --model-out "$out/tl072_model.json" --json "$out/tl072_result.json" --report "$out/tl072.html"
