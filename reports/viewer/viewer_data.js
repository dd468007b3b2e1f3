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

// A chunk of so many frames.
function decoded(buffer, about, frames) {
  const bytes = new Uint8Array(buffer);
  switch (about.coding) {
    case "byte_planes": return fromBytePlanes(bytes, frames, about.length);
    case "motion": return fromMotion(bytes, frames, about.length);
    case "frame_changes": return fromFrameChanges(bytes, about.length);
  }
  switch (about.type) {
    case "u32": return new Uint32Array(buffer);
    case "f32": return new Float32Array(buffer);
    case "u16": return new Uint16Array(buffer);
  }
  return bytes;
}

// Frames of numbers, unpacked a chunk at a time when they are wanted. `texts(id)` is an element's
// text.
class FrameArray {
  static mostChunks = 8;  // unpacked at a time

  constructor(about, texts) {
    this.about = about;
    this.texts = texts;
    this.frames = about.frames;
    this.length = about.length;
    this.chunks = new Map();  // number → its values; the one used last stands last
    this.coming = new Map();  // number → promise
  }
  get isOneChunk() {
    return this.frames <= this.about.chunk_frames;
  }
  // All values of an array of one chunk.
  get values() {
    return this.chunks.get(0);
  }
  chunkOf(frame) {
    return Math.floor(frame / this.about.chunk_frames);
  }
  has(frame) {
    return this.chunks.has(this.chunkOf(frame));
  }
  // Afterwards at(frame) gives the frame's values, until chunks enough of other frames were loaded.
  load(frame) {
    const chunk = this.chunkOf(frame);
    if (this.chunks.has(chunk)) return Promise.resolve();
    if (!this.coming.has(chunk)) this.coming.set(chunk, this.unpack(chunk));
    return this.coming.get(chunk);
  }
  async unpack(chunk) {
    const {about} = this;
    const frames = Math.min(about.chunk_frames, about.frames - chunk * about.chunk_frames);
    this.keep(chunk, decoded(await inflated(this.texts(about.id + chunk)), about, frames));
    this.coming.delete(chunk);
  }
  keep(chunk, values) {
    this.chunks.delete(chunk);
    this.chunks.set(chunk, values);
    if (this.chunks.size > FrameArray.mostChunks) this.chunks.delete(this.chunks.keys().next().value);
  }
  at(frame) {
    const chunk = this.chunkOf(frame), values = this.chunks.get(chunk);
    this.keep(chunk, values);
    const first = (frame - chunk * this.about.chunk_frames) * this.length;
    return values.subarray(first, first + this.length);
  }
}

// The same JSON with a FrameArray in place of each reference to an array. Arrays of one chunk are
// unpacked.
async function unpacked(value, texts) {
  if (value === null || typeof value !== "object") return value;
  if ("coding" in value) {
    const array = new FrameArray(value, texts);
    if (array.isOneChunk) await array.load(0);
    return array;
  }
  const parts = await Promise.all(Object.values(value).map(part => unpacked(part, texts)));
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

// What a page holds, packed.
function ownParcel() {
  return {content: document.getElementById("content").textContent,
          arrays: [...document.querySelectorAll("script[id^=array-]")].map(part => part.textContent)};
}

// A page in a frame whose address ends so gives its content to the page around it.
const kGive = "#give";
function isAsked() {
  return location.hash === kGive && parent !== window;
}
function give() {
  parent.postMessage({viewerParcel: ownParcel()}, "*");
}

// The content of another page, by its address relative to this one.
function parcelFrom(address) {
  const patience_ms = 30000;
  return new Promise((take, refuse) => {
    const frame = document.createElement("iframe");
    const finish = (settle, what) => {
      removeEventListener("message", receive);
      clearTimeout(timer);
      frame.remove();
      settle(what);
    };
    const receive = event => {
      if (event.source === frame.contentWindow && event.data.viewerParcel)
        finish(take, event.data.viewerParcel);
    };
    const missing = () => finish(refuse, new Error("no viewer's page at " + address));
    const timer = setTimeout(missing, patience_ms);
    addEventListener("message", receive);
    frame.addEventListener("load", () => setTimeout(missing, 3000));
    frame.hidden = true;
    frame.src = new URL(address, location.href.split("#")[0]).href + kGive;
    document.body.append(frame);
  });
}

// Several pages as one. Sequences and runs keep their page's grid and stored frames; runs of one
// sequence share it.
function merged(contents) {
  const [first] = contents;
  const page = {...first, sequences: [], runs: [], notes: contents.flatMap(content => content.notes),
                frames: Math.max(...contents.map(content => content.frames)),
                error_scale_m: Math.max(...contents.map(content => content.error_scale_m))};
  for (const content of contents) {
    const own = {grid: content.grid, stored_frames: content.stored_frames};
    const places = content.sequences.map(sequence => {
      let place = page.sequences.findIndex(other => other.hash === sequence.hash);
      if (place < 0) place = page.sequences.push({...sequence, ...own}) - 1;
      return place;
    });
    for (const run of content.runs)
      page.runs.push({...run, ...own, sequence: places[run.sequence]});
  }
  return page;
}

// This page's runs, and those of other pages (addresses relative to this one) beside them.
async function loadPage(others) {
  const own = {content: document.getElementById("content").textContent, arrays: null};
  const parcels = await Promise.all([own, ...others.map(parcelFrom)]);
  const contents = await Promise.all(parcels.map(({content, arrays}) => unpacked(
      JSON.parse(content),
      arrays ? id => arrays[id] : id => document.getElementById("array-" + id).textContent)));
  const page = merged(contents);
  page.series = seriesOf(page);
  return page;
}

// The position among an owner's stored frames of the one nearest to a frame.
function storedIndex({stored_frames: frames}, frame) {
  let low = 0, high = frames.length - 1;
  while (low < high) {
    const middle = low + high + 1 >> 1;
    if (frames[middle] <= frame) low = middle; else high = middle - 1;
  }
  const next = Math.min(low + 1, frames.length - 1);
  return frames[next] - frame < frame - frames[low] ? next : low;
}
