"use strict";
// The page's content: JSON beside arrays, which packing.h describes.

async function inflated(base64) {
  const binary = atob(base64);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}

function fromBytePlanes(bytes, frames, length) {
  const values = new Uint16Array(frames * length);
  for (let frame = 0; frame < frames; ++frame) {
    const to = frame * length, low = 2 * to, high = low + length;
    for (let i = 0; i < length; ++i) values[to + i] = bytes[low + i] | bytes[high + i] << 8;
  }
  return values;
}

// Takes back what MotionCoded in packing.cpp did; a Uint16Array wraps round at 16 bits.
function fromMotion(bytes, frames, length) {
  const values = new Uint16Array(frames * length);
  const vertices = length / 3;
  for (let frame = 0; frame < frames; ++frame) {
    const to = frame * length, one = to - length, two = one - length;
    for (let axis = 0; axis < 3; ++axis) {
      let change = 0, low = 2 * to + axis * vertices, high = low + length;
      for (let i = axis; i < length; i += 3, ++low, ++high) {
        const code = bytes[low] | bytes[high] << 8;
        change += code >> 1 ^ -(code & 1);
        values[to + i] =
            change + (frame > 0 ? 2 * values[one + i] : 0) - (frame > 1 ? values[two + i] : 0);
      }
    }
  }
  return values;
}

function fromFrameChanges(bytes, length) {
  for (let i = length; i < bytes.length; ++i) bytes[i] += bytes[i - length];
  return bytes;
}

function decoded(buffer, about) {
  const bytes = new Uint8Array(buffer);
  switch (about.coding) {
    case "byte_planes": return fromBytePlanes(bytes, about.frames, about.length);
    case "motion": return fromMotion(bytes, about.frames, about.length);
    case "frame_changes": return fromFrameChanges(bytes, about.length);
  }
  switch (about.type) {
    case "u32": return new Uint32Array(buffer);
    case "f32": return new Float32Array(buffer);
    case "u16": return new Uint16Array(buffer);
  }
  return bytes;
}

// Frames of numbers.
class FrameArray {
  constructor(values, frames, length) {
    this.values = values;
    this.frames = frames;
    this.length = length;
  }
  at(frame) {
    return this.values.subarray(frame * this.length, (frame + 1) * this.length);
  }
}

async function unpackedArray(about) {
  const element = document.getElementById("array-" + about.id);
  const values = decoded(await inflated(element.textContent), about);
  element.remove();
  return new FrameArray(values, about.frames, about.length);
}

// The same JSON with a FrameArray in place of each reference to an array.
async function unpacked(value) {
  if (value === null || typeof value !== "object") return value;
  if ("coding" in value) return unpackedArray(value);
  const parts = await Promise.all(Object.values(value).map(unpacked));
  if (Array.isArray(value)) return parts;
  return Object.fromEntries(Object.keys(value).map((key, i) => [key, parts[i]]));
}

// Numbers per frame of all runs, by name: those of the record and the error of each joint.
// values[run][frame] is NaN where there is none.
function seriesOf(page) {
  const all = new Map();
  const add = (run, about, values) => {
    if (!all.has(about.key)) {
      all.set(about.key, {...about, values: page.runs.map(() => null)});
    }
    all.get(about.key).values[run] = values;
  };
  page.runs.forEach((run, r) => {
    for (const series of run.series) add(r, series, series.values.values);
    const truth = page.sequences[run.sequence].joints;
    if (!truth) return;
    truth.names.forEach((name, at) => {
      const bone = page.bones.findIndex(b => b.joint === name);
      if (bone < 0) return;
      const values = new Float32Array(run.frames);
      for (let frame = 0; frame < run.frames; ++frame) {
        const a = run.joints.at(frame), b = truth.positions.at(frame);
        values[frame] = 1e3 * Math.hypot(a[3 * bone] - b[3 * at], a[3 * bone + 1] - b[3 * at + 1],
                                         a[3 * bone + 2] - b[3 * at + 2]);
      }
      add(r, {key: "joint:" + name, label: "joint error: " + name.replaceAll("_", " "),
              unit: "mm", definition: "Distance of the estimated joint from the true one."}, values);
    });
  });
  return all;
}

async function loadPage() {
  const page = await unpacked(JSON.parse(document.getElementById("content").textContent));
  page.series = seriesOf(page);
  return page;
}

// The position in page.stored_frames of the stored frame nearest to a frame.
function storedIndex(page, frame) {
  const frames = page.stored_frames;
  let low = 0, high = frames.length - 1;
  while (low < high) {
    const middle = low + high + 1 >> 1;
    if (frames[middle] <= frame) low = middle; else high = middle - 1;
  }
  const next = Math.min(low + 1, frames.length - 1);
  return frames[next] - frame < frame - frames[low] ? next : low;
}
