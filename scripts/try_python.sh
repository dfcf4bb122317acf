#!/usr/bin/env bash
# Installs the Python package in a fresh Debian 12, from what is committed, by the lines that the
# README gives, and runs the README's Python there as it stands.
# Usage (as root): scripts/try_python.sh
#   CCACHE_DIR  in the environment: a store of ccache that the build there may use
# The fresh Debian is made by debootstrap in a temporary folder and removed at the end.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/fresh_debian.sh

work=$(mktemp -d)
root=$work/debian
mounts=()
clean_up() {
  for mount in "${mounts[@]}"; do umount "$mount"; done
  # Nothing of the machine is mounted below this folder any more, or it stays.
  rm -rf --one-file-system "$work"
}
trap clean_up EXIT
fresh_debian "$root"
mount -t proc proc "$root/proc"
mounts+=("$root/proc")
mkdir -p "$root$PWD"
git archive HEAD | tar -x -C "$root$PWD"
# Nothing of this machine's environment goes there, but a store of ccache and what packages are
# trusted by: behind a proxy that has a certificate of its own.
cp -L /etc/ssl/certs/ca-certificates.crt "$root/certificates.crt"
environment=(PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 PIP_CERT=/certificates.crt)
if [ -n "${CCACHE_DIR:-}" ]; then
  mkdir -p "$root$CCACHE_DIR"
  mount --bind "$CCACHE_DIR" "$root$CCACHE_DIR"
  mounts+=("$root$CCACHE_DIR")
  environment+=(CCACHE_DIR="$CCACHE_DIR" CCACHE_COMPILERCHECK=content)
fi
awk '/^```python$/ { inside = 1; next } /^```$/ { inside = 0 } inside' README.md > "$root/readme.py"
[ -s "$root/readme.py" ]

cat > "$root/run.sh" <<'RUN'
set -euxo pipefail
cd "$1"
. scripts/core_seconds.sh
scripts/setup.sh python
python3 -m venv /fresh
. /fresh/bin/activate
begin=$SECONDS spent=$(core_seconds)
pip install -q .
{ echo "try_python: installed in $((SECONDS - begin)) s, $(($(core_seconds) - spent)) s of a core"; } 2> /dev/null
python /readme.py
[ -s out.html ]
python -c 'import lacuna; print(lacuna.build_info())'
RUN
env -i "${environment[@]}" chroot "$root" /bin/bash /run.sh "$PWD"
echo "try_python: pip install . and the Python of the README run in a fresh Debian 12"
