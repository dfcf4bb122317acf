#!/usr/bin/env bash
# Installs what lacuna needs from the packages of Debian 12 or Ubuntu 24.04. Does nothing when all
# of it is there. Run as root, or as a user who may use sudo.
set -euo pipefail

packages=(
  g++ cmake ninja-build ccache git ca-certificates
  libeigen3-dev            # linear algebra
  libceres-dev             # nonlinear least squares: an inner solver
  libnlopt-dev libnlopt-cxx-dev  # nonlinear optimisation: an inner solver
  libsuitesparse-dev       # sparse factorisations behind Ceres
  nlohmann-json3-dev       # model files and configurations
  libcli11-dev             # command line
  zlib1g-dev               # compressed records
  libgtest-dev libgmock-dev libbenchmark-dev
)

missing=()
for package in "${packages[@]}"; do
  # "install ok installed" is the only state in which a package is usable.
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' ||
    missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  echo "setup: nothing to install"
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || {
    echo "setup: run as root, or install these packages yourself: ${missing[*]}" >&2
    exit 2
  }
  as_root=(sudo)
fi
echo "setup: installing ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update -q
"${as_root[@]}" apt-get install -q -y --no-install-recommends "${missing[@]}"
