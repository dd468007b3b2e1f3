#!/usr/bin/env bash
# install_packages.sh PACKAGE...: installs exactly those Debian packages that are missing. Where none
# is, it is done at once and needs neither network nor rights. Where it cannot install, it says which
# packages are missing and why, and fails.
set -euo pipefail

missing_of() {
  local installed
  installed=$(dpkg-query --show --showformat='${Package} ${db:Status-Status}\n' "$@" 2>/dev/null || true)
  for package in "$@"; do
    grep -qx "$package installed" <<<"$installed" || printf '%s ' "$package"
  done
}

fail() {
  printf '\n%s\nMissing packages: %s\nWhere they are provided in another way, build with: make\n' "$1" "$2" >&2
  exit 1
}

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  fail "This is no Debian: packages cannot be installed here, nor looked up." "any of: $*"
fi
missing=$(missing_of "$@")
[ -n "$missing" ] || exit 0

as_root=()
if [ "$(id -u)" != 0 ]; then
  command -v sudo >/dev/null || fail "Packages are missing, and there is neither root nor sudo to install them." "$missing"
  as_root=(sudo)
fi
printf 'Installing: %s\n' "$missing"
# A package source that does not answer need not be one that is needed: the installation decides.
"${as_root[@]}" apt-get update || printf 'apt-get update failed; trying with the package lists that are here.\n' >&2
read -ra packages <<<"$missing"
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install --yes --no-install-recommends "${packages[@]}" ||
  fail "apt-get could not install what is missing (see above)." "$(missing_of "$@")"
