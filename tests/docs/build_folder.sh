#!/usr/bin/env bash
# build_folder.sh SOURCE: a copied checkout with a build folder refuses it; the checkout itself and a
# folder that is not configured do not.
set -euo pipefail
source=$1
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
cp -r "$source/Makefile" "$source/CMakePresets.json" "$source/cmake" "$copy"
"$copy/cmake/check_build_folder.sh" "$copy/build"

for build in build build-dev; do
  mkdir "$copy/$build"
  touch "$copy/$build/build.ninja"
  echo "CMAKE_HOME_DIRECTORY:INTERNAL=/elsewhere" > "$copy/$build/CMakeCache.txt"
  goal=${build#build-}
  if message=$(make -C "$copy" "$goal" 2>&1); then
    echo "make $goal accepts a build folder of another checkout"
    exit 1
  fi
  grep -q "$build was configured for the checkout /elsewhere, not for this one" <<< "$message"
done
echo "CMAKE_HOME_DIRECTORY:INTERNAL=$copy" > "$copy/build/CMakeCache.txt"
"$copy/cmake/check_build_folder.sh" "$copy/build"
