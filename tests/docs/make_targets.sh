#!/usr/bin/env bash
# Every target that `make help` lists can be made in a checkout without any build folder: make
# finds a rule for all that it needs. Nothing is built.
#
# usage: make_targets.sh CHECKOUT
set -euo pipefail

fresh=$(mktemp -d)
trap 'rm -rf "$fresh"' EXIT
for entry in "$1"/*; do
  [[ $(basename "$entry") == build* ]] || ln -s "$entry" "$fresh/"
done

failed=0
while read -r _ target _; do
  if ! said=$(make --dry-run --directory "$fresh" "$target" 2>&1); then
    echo "make $target: $said"
    failed=1
  fi
done < <(make --no-print-directory --directory "$fresh" help)
exit $failed
