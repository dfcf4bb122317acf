#!/usr/bin/env bash
# Installs what lacuna needs from the packages of Debian 12 or Ubuntu 24.04. Does nothing when all
# of it is there. Run as root, or as a user who may use sudo.
# Usage: scripts/setup.sh [tests|check|clang|style|docs|coverage|python]...   (without: what the program needs;
# tests: and what tests and benchmarks are built with; check: and the programs without which tests are
# skipped; clang: and what builds with sanitizers and fuzzing need; style: and what looks at changed
# lines; docs: and what makes the documentation; coverage: and what counts lines that tests run; python:
# and what builds the Python package, which check has too)
set -euo pipefail

packages=(
  g++ cmake ninja-build
  libeigen3-dev            # linear algebra
  libceres-dev             # nonlinear least squares: an inner solver
  libnlopt-dev libnlopt-cxx-dev  # nonlinear optimisation: an inner solver
  libsuitesparse-dev       # sparse factorisations: CHOLMOD, also behind Ceres
  libsundials-dev          # CVODE: stiff models
  nlohmann-json3-dev       # model files and configurations
  libcli11-dev             # command line
  libboost-dev             # Boost.Math: quantiles
  zlib1g-dev               # compressed records
  libexpat1-dev            # workbooks: .xlsx, .ods
  libmatio-dev libhdf5-dev # records of MATLAB, HDF5 and netCDF
)
build_packages=(
  ccache git ca-certificates
  libopenmpi-dev openmpi-bin  # several machines: lacuna-mpi
  libgtest-dev libgmock-dev libbenchmark-dev
  rapidjson-dev            # checks of JSON schemas, in the tests
)

as_root=()
[ "$(id -u)" -eq 0 ] || as_root=(sudo)

# "install ok installed" is the only state in which a package is usable.
is_installed() {
  dpkg-query -W -f='${Status}' "$1" 2>/dev/null | grep -q 'install ok installed'
}

install() {
  local package missing=()
  for package in "$@"; do
    is_installed "$package" || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  if [ ${#as_root[@]} -gt 0 ] && ! command -v sudo >/dev/null; then
    echo "setup: run as root, or install these packages yourself: ${missing[*]}" >&2
    exit 2
  fi
  echo "setup: installing ${missing[*]}"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -q
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -q -y --no-install-recommends "${missing[@]}"
  installed=true
}

# What runs, compiles or shows an answer in tests.
test_packages=(
  python3 python3-numpy python3-scipy  # hostile inputs; models in Python
  octave                   # models in MATLAB's language
  ngspice                  # models as circuits
  texlive-latex-base       # equations in LaTeX
  python3-pygments         # words of the languages of exports
)
python_packages=(python3-dev python3-venv)
# Reports; Ubuntu's Chromium is no package but a snap.
grep -q '^ID=ubuntu' /etc/os-release || test_packages+=(chromium)

installed=false
for part in "$@"; do
  case $part in
    tests) packages+=("${build_packages[@]}") ;;
    check) packages+=("${build_packages[@]}" "${test_packages[@]}" "${python_packages[@]}") ;;
    python) packages+=("${python_packages[@]}") ;;
    clang) packages+=(clang) ;;
    style) packages+=(clang-format clang-tidy) ;;
    docs) packages+=(doxygen libjs-katex python3-venv) ;;
    coverage) packages+=(gcovr) ;;
    *) echo "setup: '$part' is none of tests, check, clang, style, docs, coverage, python" >&2; exit 2 ;;
  esac
done
install "${packages[@]}"
# The sanitizers of the clang that there is now.
case " $* " in
  *" clang "*) install "libclang-rt-$(clang++ -dumpversion | cut -d. -f1)-dev" ;;
esac
$installed || echo "setup: nothing to install"
