#!/usr/bin/env python3
"""A tracker outside of vitruvia, as src/methods/external/PROTOCOL.md wants it; no libraries.

It moves the subject's rest pose to where the depth is, without turning or bending it. For tests:
--replay SEQUENCE answers with a sequence's own truth, --fault NAME does something wrong in frame 2.
"""
import array
import json
import os
import sys
import time


def read_template(folder):
    """The vertices of mesh.ply (binary, vertices first) and the joints, subject frame."""
    with open(os.path.join(folder, "mesh.ply"), "rb") as ply:
        count = 0
        for line in iter(ply.readline, b"end_header\n"):
            words = line.split()
            if words[:2] == [b"element", b"vertex"]:
                count = int(words[2])
        vertices = array.array("f", ply.read(12 * count))
    with open(os.path.join(folder, "subject.json")) as file:
        bones = json.load(file)["bones"]
    return vertices, [bone["joint"] for bone in bones]


def facing_the_camera(point):
    """Subject frame (y up, z to the front) to camera frame (y down, z away), without a shift."""
    return [point[0], -point[1], -point[2]]


def middle_of_box(points):
    return [(min(axis) + max(axis)) / 2 for axis in zip(*points)]


def unproject(depth, camera):
    width = camera["width"]
    points = []
    for i, z in enumerate(depth):
        if z > 0:
            points.append([(i % width - camera["cx"]) / camera["fx"] * z,
                           (i // width - camera["cy"]) / camera["fy"] * z, z])
    return points


class RestPose:
    """Shifts the template so that its front half lies where the depth is."""

    def __init__(self, start):
        self.camera = start["camera"]
        flat, joints = read_template(start["subject"])
        self.vertices = [facing_the_camera(flat[i:i + 3]) for i in range(0, len(flat), 3)]
        self.joints = [facing_the_camera(joint) for joint in joints]

    def estimate(self, index, depth):
        points = unproject(depth, self.camera)
        if not points:
            return "no_data", self.joints, self.vertices
        seen, own = middle_of_box(points), middle_of_box(self.vertices)
        shift = [seen[0] - own[0], seen[1] - own[1],
                 min(p[2] for p in points) - min(v[2] for v in self.vertices)]
        move = lambda p: [p[k] + shift[k] for k in range(3)]
        return "converged", [move(p) for p in self.joints], [move(p) for p in self.vertices]


class Replay:
    """The truth as the estimate: it must score perfectly."""

    def __init__(self, start, sequence):
        with open(os.path.join(sequence, "truth", "joints.json")) as file:
            self.joints = [frame["positions"] for frame in json.load(file)["frames"]]
        self.file = open(os.path.join(sequence, "truth", "vertices.bin"), "rb")
        self.count = start["vertices"]

    def estimate(self, index, depth):
        self.file.seek(12 * self.count * index)
        flat = array.array("f", self.file.read(12 * self.count))
        return "converged", self.joints[index], [flat[i:i + 3] for i in range(0, len(flat), 3)]


def main():
    options = dict(zip(sys.argv[1::2], sys.argv[2::2]))
    source, sink = sys.stdin.buffer, sys.stdout.buffer

    def say(message):
        sink.write(json.dumps(message).encode() + b"\n")

    start = json.loads(source.readline())
    tracker = Replay(start, options["--replay"]) if "--replay" in options else RestPose(start)
    say({"type": "ready"})
    sink.flush()
    for line in source:
        frame = json.loads(line)
        depth = array.array("f", source.read(frame["depth_bytes"]))
        outcome, joints, vertices = tracker.estimate(frame["index"], depth)
        answer = {"type": "estimate", "outcome": outcome, "joints": joints,
                  "energies": [["none", 0.0]], "message": "" if outcome == "converged" else "no body"}
        fault = options.get("--fault") if frame["index"] == 2 else None
        if fault == "end":
            sys.exit(3)
        if fault == "hang":
            time.sleep(600)
        if fault == "talk":
            sink.write(b"tracking...\n")
        if fault == "joints":
            answer["joints"] = joints[:16]
        if fault == "outcome":
            answer["outcome"] = "fine"
        if fault == "names":
            answer["energies"] = []
        if fault == "numbers":
            vertices[5] = [float("nan")] * 3
        say(answer)
        for vertex in vertices:
            sink.write(array.array("f", vertex).tobytes())
        sink.flush()


main()
