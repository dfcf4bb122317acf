#!/usr/bin/env bash
# Makes the site of the documentation, build/docs/site: the pages and the interface. What is
# linked and is not there, and a page that is nowhere in the navigation, are errors.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh docs
mkdir -p build/docs
tools=build/docs/tools
[ -x $tools/bin/pip ] || python3 -m venv $tools
$tools/bin/pip install -q 'mkdocs==1.6.*' 'mkdocs-material==9.5.*'
rm -rf build/docs/api build/docs/site
doxygen site/Doxyfile
$tools/bin/mkdocs build -f site/mkdocs.yml
python3 site/check_links.py build/docs/site
echo "docs: build/docs/site/index.html; with its search: python3 -m http.server -d build/docs/site"
