# A recording as docs/own_data.md describes it: depth images of a room without and then with a
# person, a space of a few bodies and an experiment, all from a small synthetic scene. $EDITOR changes
# nothing.
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
               "empty_frames": {"first": 0, "count": 5},
               "cutout": {"background": {"source": "empty_frames"}, "far_m": 8}}, file)
with open("mine.json", "w", encoding="utf-8") as file:
    json.dump({"title": "Mine", "sequences": ["seq"], "methods": ["configs/methods/realtime_scape.json"],
               "variants": [{"name": "mine", "subject": "subject"}]}, file)
with open("few_bodies.json", "w", encoding="utf-8") as file:
    json.dump({"database": {"population": {"source": "mannequin", "subjects": 20, "seed": 1},
                            "mesh": {"subdivisions": 1}, "subjects_with_poses": 1,
                            "poses": {"motions": ["configs/motions/walk.json"]}},
               "weights": {"neighbour_steps": 1},
               "shape": {"form": "vertices", "components": 8}, "held_out": 2}, file)
PYTHON
build/vitruvia learn shape few_bodies.json -o space
build/vitruvia synth room.json -o made
mkdir depth
for image in made/empty_room/*.png; do cp "$image" "depth/0_$(basename "$image")"; done
for image in made/depth/*.png; do cp "$image" "depth/1_$(basename "$image")"; done
