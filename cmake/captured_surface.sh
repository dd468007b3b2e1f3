#!/usr/bin/env bash
# Makes the sequences of the captured surface (configs/imports/crane*.json) below
# out/captured/crane: meshes, a space of bodies to compare with, the rigged subject, depth. What is
# there stays.
# usage: captured_surface.sh PROGRAM
set -euo pipefail
program=$1
data=${VITRUVIA_DATA:-}/real_surfaces
folder=out/captured/crane
[ -e $folder/kinect_one/sequence.json ] && exit 0
if [ -z "${VITRUVIA_DATA:-}" ] || ! [ -e "$data/crane" -o -e "$data/unpack.py" ]; then
  echo "The captured surface is left out: expected its meshes in \$VITRUVIA_DATA/real_surfaces/crane," \
       "or unpack.py beside them; VITRUVIA_DATA is '${VITRUVIA_DATA:-}'." >&2
  exit 0
fi
mkdir -p $folder
if [ -e "$data/crane" ]; then
  ln -sfn "$(realpath "$data/crane")" $folder/meshes
elif ! [ -e $folder/meshes ]; then
  rm -rf $folder/meshes.part
  if ! /usr/bin/python3 "$data/unpack.py" $folder/meshes.part; then
    echo "The captured surface is left out: $data/unpack.py failed, see above (it wants Debian's" \
         "python3-numpy)." >&2
    exit 0
  fi
  mv $folder/meshes.part $folder/meshes
fi
[ -e $folder/space ] || $program learn shape configs/learning/mannequin_small.json -o $folder/space
[ -e $folder/subject ] ||
  $program rig $folder/meshes --space $folder/space --height 1.81 --sex male -o $folder/subject
# For figures of all methods: from a frame on in which each method's search finds him, since a method
# that does not find him searches for a second in each frame.
first=49
if ! [ -e $folder/sequence/sequence.json ]; then
  rm -rf $folder/frames
  mkdir $folder/frames
  for mesh in $(ls $folder/meshes | tail -n +$first); do ln -s ../meshes/$mesh $folder/frames/; done
  $program import meshes configs/imports/crane.json -o $folder/sequence
fi
# For configs/captured/crane.json: all frames.
for sensor in ideal kinect_v1 kinect_one; do
  [ -e $folder/$sensor/sequence.json ] ||
    $program import meshes configs/imports/crane_$sensor.json -o $folder/$sensor
done
