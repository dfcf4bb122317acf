#!/usr/bin/env bash
# Makes a site of the documentation: the pages and the interface. What it cannot resolve is an error.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh docs
mkdir -p build/docs
doxygen docs/Doxyfile
echo "docs: build/docs/html/index.html"
