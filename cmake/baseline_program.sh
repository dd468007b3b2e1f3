#!/usr/bin/env bash
# Prints the path of the program of the commit at which a baseline was renewed. It is built from git
# once, into build-baseline/<commit>. Prints nothing, and says why on standard error, where there is
# no git history that holds the commit or the commit does not build.
#
# usage: baseline_program.sh reports/baseline/nightly.json
set -euo pipefail

baseline=$1
root=$(cd "$(dirname "$0")/.." && pwd)
# The file's own "commit" stands before those of its renewals.
commit=$(sed -n 's/^ "commit": "\([0-9a-f]*\)",\?$/\1/p' "$baseline" | head -n 1)

give_up() {
  echo "speed will not be judged: $1" >&2
  exit 0
}

[ -n "$commit" ] || give_up "$baseline names no commit"
git -C "$root" cat-file -e "$commit^{commit}" 2> /dev/null ||
  give_up "commit $commit of $baseline is not in this checkout's history"

source=$root/build-baseline/$commit
program=$source/build/vitruvia
if [ ! -x "$program" ]; then
  echo "building the baseline's program, commit $commit, once" >&2
  rm -rf "$source"
  git clone --quiet --shared --no-checkout "$root" "$source"
  git -C "$source" checkout --quiet "$commit"
  {
    cmake -S "$source" -B "$source/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DVITRUVIA_UNITY=ON &&
      cmake --build "$source/build" --target vitruvia
  } > "$source/build.log" 2>&1 || give_up "commit $commit does not build, see $source/build.log"
fi
echo "$program"
