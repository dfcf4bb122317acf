#!/usr/bin/env bash
# Sets up a fresh machine, builds lacuna and identifies the equations of the shipped record.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh
cmake --preset release
cmake --build --preset release

out=build/demo
mkdir -p "$out"
set -x
build/release/lacuna identify data/tl072_record.csv.gz \
  --model-out "$out/tl072_model.json" --json "$out/tl072_result.json"
