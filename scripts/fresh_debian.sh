# Sourced. fresh_debian FOLDER makes a Debian 12 there by debootstrap, as root; its packages are what
# the package manager of Debian holds necessary, so what a program does not ask for is missing.
fresh_debian() {
  local name
  name=$(basename "$0" .sh)
  [ "$(id -u)" -eq 0 ] || { echo "$name: run as root" >&2; exit 2; }
  command -v debootstrap > /dev/null ||
    { echo "$name: install the package debootstrap" >&2; exit 2; }
  debootstrap --variant=minbase bookworm "$1" > "$1.log" || { tail -5 "$1.log" >&2; exit 1; }
}
