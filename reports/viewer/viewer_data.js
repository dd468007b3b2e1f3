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

// See EarlierNeighbours in packing.h: those of vertex v are indices[begins[v]] … indices[begins[v + 1] - 1].
function earlierNeighbours(triangles, vertices) {
  const begins = new Uint32Array(vertices + 1), edges = [];
  for (let t = 0; t < triangles.length; t += 3) {
    for (let k = 0; k < 3; ++k) {
      const from = triangles[t + k], to = triangles[t + (k + 1) % 3];
      if (to < from) edges.push(from, to);
    }
  }
  for (let e = 0; e < edges.length; e += 2) ++begins[edges[e] + 1];
  for (let v = 1; v < vertices; ++v) if (begins[v + 1] === 0) edges.push(v, v - 1), begins[v + 1] = 1;
  for (let v = 0; v < vertices; ++v) begins[v + 1] += begins[v];
  const next = begins.slice(), indices = new Uint32Array(edges.length / 2);
  for (let e = 0; e < edges.length; e += 2) indices[next[edges[e]]++] = edges[e + 1];
  return {begins, indices, vertices};
}

// Takes back what SurfaceCoded in packing.cpp did; arrays of 8 and 16 bits wrap round.
function fromSurface(codes, frames, length, {begins, indices, vertices}) {
  const values = new codes.constructor(frames * length), parts = length / vertices;
  const change = new Int32Array(length);
  for (let frame = 0; frame < frames; ++frame) {
    const to = frame * length;
    for (let part = 0; part < parts; ++part) {
      for (let v = 0, i = part; v < vertices; ++v, i += parts) {
        const code = codes[to + part * vertices + v], begin = begins[v], end = begins[v + 1];
        let expected = 0;
        for (let n = begin; n < end; ++n) expected += change[indices[n] * parts + part];
        if (end - begin > 1) expected = Math.floor((expected + 0.5 * (end - begin)) / (end - begin));
        const before = frame > 0 ? values[to + i - length] : 0;
        values[to + i] = before + expected + (code >> 1 ^ -(code & 1));
        change[i] = values[to + i] - before;
      }
    }
  }
  return values;
}

// A chunk of so many frames. `neighbours`: of arrays on a surface.
function decoded(buffer, about, frames, neighbours) {
  const bytes = new Uint8Array(buffer);
  if (about.coding === "byte_planes") return fromBytePlanes(bytes, frames, about.length);
  if (about.coding === "surface") {
    const codes = about.type === "u16" ? fromBytePlanes(bytes, frames, about.length) : bytes;
    return fromSurface(codes, frames, about.length, neighbours);
  }
  switch (about.type) {
    case "u32": return new Uint32Array(buffer);
    case "f32": return new Float32Array(buffer);
  }
  return bytes;
}

// The arrays of one page. `textOf(id)` is an element's text.
class Arrays {
  constructor(textOf) {
    this.textOf = textOf;
    this.neighbours = new Map();  // the triangles' id → promise
  }
  buffer(id) {
    return inflated(this.textOf(id));
  }
  neighboursOf(id, vertices) {
    if (!this.neighbours.has(id)) {
      this.neighbours.set(id, this.buffer(id).then(
          triangles => earlierNeighbours(new Uint32Array(triangles), vertices)));
    }
    return this.neighbours.get(id);
  }
}

// Frames of numbers, unpacked a chunk at a time when they are wanted.
class FrameArray {
  static mostChunks = 8;  // unpacked at a time

  constructor(about, arrays) {
    this.about = about;
    this.arrays = arrays;
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
    const neighbours = "surface" in about && await this.arrays.neighboursOf(about.surface, about.vertices);
    this.keep(chunk, decoded(await this.arrays.buffer(about.id + chunk), about, frames, neighbours));
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
async function unpacked(value, arrays) {
  if (value === null || typeof value !== "object") return value;
  if ("coding" in value) {
    const array = new FrameArray(value, arrays);
    if (array.isOneChunk) await array.load(0);
    return array;
  }
  const parts = await Promise.all(Object.values(value).map(part => unpacked(part, arrays)));
  if (Array.isArray(value)) return parts;
  return Object.fromEntries(Object.keys(value).map((key, i) => [key, parts[i]]));
}

// How far a joint is expected to be off, metres: the root of the trace of its covariance, from the
// six numbers of the covariance's factor.
function expectedError_m(factor) {
  return Math.hypot(...factor);
}

// Numbers per frame of all runs, by name: those of the record, and of each joint the error and the
// error that the tracker expects.
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
    if (run.uncertainty) {
      page.bones.forEach(({joint}, bone) => {
        const values = Float32Array.from({length: run.frames}, (_, frame) =>
            1e3 * expectedError_m(run.uncertainty.at(frame).subarray(6 * bone, 6 * bone + 6)));
        add(r, {key: "uncertainty:" + joint, label: "predicted error: " + joint.replaceAll("_", " "),
                unit: "mm", definition: "Root of the trace of the covariance that the tracker gives the joint."},
            values);
      });
    }
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
      new Arrays(id => arrays ? arrays[id] : document.getElementById("array-" + id).textContent))));
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
