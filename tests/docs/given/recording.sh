# A recording as docs/own_data.md describes it: depth images of a room without and then with a
# person, all from a small synthetic scene. $EDITOR changes nothing.
export EDITOR=true
python3 - <<'PYTHON'
import json
with open("configs/scenes/room_walk.json", encoding="utf-8") as file:
    scene = json.load(file)
scene["view"]["camera"] = {"width": 320, "height": 240, "fx": 285, "fy": 285, "cx": 159.5, "cy": 119.5}
scene["motion"]["file"] = "configs/motions/walk.json"
scene["frames"], scene["room"]["empty_frames"] = 12, 5
with open("room.json", "w", encoding="utf-8") as file:
    json.dump(scene, file)
with open("recording.json", "w", encoding="utf-8") as file:
    json.dump({"images": "depth", "camera": scene["view"]["camera"], "unit_m": 0.001,
               "empty_frames": {"first": 0, "count": 5}, "frames": {"first": 5},
               "cutout": {"background": {"source": "empty_frames"}, "far_m": 8}}, file)
PYTHON
build/vitruvia synth room.json -o made
mkdir depth
for image in made/empty_room/*.png; do cp "$image" "depth/0_$(basename "$image")"; done
for image in made/depth/*.png; do cp "$image" "depth/1_$(basename "$image")"; done
