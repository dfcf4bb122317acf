#!/usr/bin/env bash
# Installs the Debian package in a fresh Debian 12 and identifies and diagnoses there.
# Usage (as root): scripts/try_package.sh [BUILD]
# BUILD is a built folder (default: build/release, which is built first). The fresh Debian is made by
# debootstrap in a temporary folder and removed at the end; it is the packages' only source of
# libraries, so what the package does not ask for is missing there.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/fresh_debian.sh

command -v dpkg-shlibdeps > /dev/null ||
  { echo "try_package: install the package dpkg-dev" >&2; exit 2; }

build=${1:-build/release}
if [ $# -eq 0 ]; then
  scripts/setup.sh
  cmake --preset release
  cmake --build --preset release
fi
work=$(mktemp -d)
# Nothing of the machine is mounted below this folder.
trap 'rm -rf --one-file-system "$work"' EXIT
cpack -G DEB --config "$build/CPackConfig.cmake" -B "$work/package"
root=$work/debian
fresh_debian "$root"

mkdir "$root/try"
cp "$work"/package/*.deb "$root/try/lacuna.deb"
cp data/*.csv.gz data/pendulum.ode "$root/try"
cat > "$root/try/run.sh" <<'RUN'
set -euxo pipefail
cd /try
export DEBIAN_FRONTEND=noninteractive
apt-get update -q
apt-get install -q -y --no-install-recommends ./lacuna.deb
lacuna --version
lacuna identify tl072_record.csv.gz --json identified.json
lacuna diagnose --model pendulum.ode pendulum_scope_1.csv.gz \
  --holdout pendulum_scope_2.csv.gz --map th=CH1,w=CH2,u=CH3 --json diagnosed.json
[ -s identified.json ] && [ -s diagnosed.json ]
[ -f /usr/share/man/man1/lacuna.1.gz ] || [ -f /usr/share/man/man1/lacuna.1 ]
[ -f /usr/share/doc/lacuna/LICENSE ]
apt-get remove -q -y lacuna
[ ! -e /usr/bin/lacuna ] && [ ! -e /usr/include/lacuna ]
RUN
chroot "$root" /bin/bash /try/run.sh
echo "try_package: $(basename "$work"/package/*.deb) installs, identifies and diagnoses"
