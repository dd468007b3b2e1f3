#!/usr/bin/env bash
# Refuses a build folder that was configured for another checkout, as a copy of a checkout has it:
# what is built there comes from the other's files.
#
# usage: check_build_folder.sh build
set -euo pipefail

build=$1
cache=$build/CMakeCache.txt
[ -f "$cache" ] || exit 0
root=$(cd "$(dirname "$0")/.." && pwd -P)
home=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$cache")
[ "$(cd "$home" 2> /dev/null && pwd -P || echo "$home")" = "$root" ] && exit 0
echo "make: $build was configured for the checkout $home, not for this one, $root." \
     "Remove it and make again: rm -rf $build" >&2
exit 2
