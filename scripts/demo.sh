#!/usr/bin/env bash
# Sets up a fresh machine, builds lacuna, tells what a pendulum's model lacks, identifies the equations
# of the shipped circuit, and writes both answers as reports.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh
cmake --preset release
cmake --build --preset release --target lacuna-cli

out=build/demo
mkdir -p "$out"
set -x
build/release/lacuna diagnose --model data/pendulum.ode data/pendulum_scope_1.csv.gz \
  --holdout data/pendulum_scope_2.csv.gz --map th=CH1,w=CH2,u=CH3 --report "$out/pendulum.html"
build/release/lacuna identify data/tl072_record.csv.gz \
  --model-out "$out/tl072_model.json" --json "$out/tl072_result.json" --report "$out/tl072.html"
