"use strict";
// The picture: one scene for each run, drawn beside each other or over each other, from one view.
// Stored positions are in the depth camera's frame, y down and z forward; scenes turn them so that
// y is up.

const kLengths = new Set(["error", "warp"]);  // colours that stand for a length of each vertex
const kRegion95 = Math.sqrt(7.815);  // standard deviations: 95 % of a normal distribution in space
const kTruthBesideRuns = [150, 150, 150];  // the colours of runs stand for runs
const kHalfAngleTangent = Math.tan(20 * Math.PI / 180);  // of the view, in the pane's shorter direction
const kUnknownColor = [150, 150, 150];
const kHiddenColor = [70, 90, 150];
const kVisibleColor = [235, 215, 130];

function colorOf(rgb) {
  return new THREE.Color(rgb[0] / 255, rgb[1] / 255, rgb[2] / 255);
}

// Smooth normals of a mesh on the grid; `normals` is written.
function setNormals(positions, triangles, normals) {
  normals.fill(0);
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
    const ux = positions[b] - positions[a], uy = positions[b + 1] - positions[a + 1],
          uz = positions[b + 2] - positions[a + 2];
    const vx = positions[c] - positions[a], vy = positions[c + 1] - positions[a + 1],
          vz = positions[c + 2] - positions[a + 2];
    const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    normals[a] += nx; normals[a + 1] += ny; normals[a + 2] += nz;
    normals[b] += nx; normals[b + 1] += ny; normals[b + 2] += nz;
    normals[c] += nx; normals[c + 1] += ny; normals[c + 2] += nz;
  }
}

// A triangle mesh or, without triangles, points, whose positions change from frame to frame.
class MovingSurface {
  constructor(surface, grid, color, opacity) {
    this.surface = surface;
    this.triangles = surface.triangles ? surface.triangles.values : null;
    const count = surface.shown;
    const geometry = this.geometry = new THREE.BufferGeometry();
    this.position = new THREE.BufferAttribute(new Uint16Array(3 * count), 3);
    this.color = new THREE.BufferAttribute(new Uint8Array(3 * count).fill(255), 3, true);
    geometry.setAttribute("position", this.position);
    geometry.setAttribute("color", this.color);
    this.plain = colorOf(color);
    const look = {color: this.plain, vertexColors: THREE.VertexColors,
                  transparent: opacity < 1, opacity: opacity, depthWrite: opacity === 1};
    if (this.triangles) {
      this.normal = new THREE.BufferAttribute(new Float32Array(3 * count), 3);
      geometry.setAttribute("normal", this.normal);
      geometry.setIndex(new THREE.BufferAttribute(this.triangles, 1));
      this.object = new THREE.Mesh(
          geometry, new THREE.MeshLambertMaterial({...look, side: THREE.DoubleSide}));
    } else {
      this.object = new THREE.Points(
          geometry, new THREE.PointsMaterial({...look, size: 2.5, sizeAttenuation: false}));
    }
    this.object.frustumCulled = false;
    this.object.position.fromArray(grid.origin);
    this.object.scale.setScalar(grid.step_m);
  }

  needs(stored) {
    return [[this.surface.positions, stored]];
  }

  show(stored) {
    this.position.array.set(this.surface.positions.at(stored));
    this.position.needsUpdate = true;
    if (!this.triangles) return;
    setNormals(this.position.array, this.triangles, this.normal.array);
    this.normal.needsUpdate = true;
  }

  // colorOfVertex(v) gives red, green and blue; null: the surface's own colour.
  paint(colorOfVertex) {
    this.object.material.color.copy(colorOfVertex ? new THREE.Color(1, 1, 1) : this.plain);
    const colors = this.color.array;
    for (let v = 0; v < this.surface.shown; ++v) {
      const rgb = colorOfVertex ? colorOfVertex(v) : [255, 255, 255];
      colors[3 * v] = rgb[0]; colors[3 * v + 1] = rgb[1]; colors[3 * v + 2] = rgb[2];
    }
    this.color.needsUpdate = true;
  }
}

// What the camera measured.
class DepthPoints {
  constructor(sequence, ramp) {
    this.sequence = sequence;
    this.ramp = ramp;
    const count = sequence.depth.columns * sequence.depth.rows;
    const geometry = this.geometry = new THREE.BufferGeometry();
    this.position = new THREE.BufferAttribute(new Float32Array(3 * count), 3);
    this.color = new THREE.BufferAttribute(new Uint8Array(3 * count), 3, true);
    geometry.setAttribute("position", this.position);
    geometry.setAttribute("color", this.color);
    this.object = new THREE.Points(geometry, new THREE.PointsMaterial(
        {vertexColors: THREE.VertexColors, size: 2.5, sizeAttenuation: false}));
    this.object.frustumCulled = false;
    // Nearest and farthest depth of all frames: colours mean the same in each.
    this.nearest = sequence.depth.nearest;
    this.span = Math.max(1, sequence.depth.farthest - this.nearest);
  }

  needs(stored) {
    return [[this.sequence.depth.values, stored]];
  }

  show(stored) {
    const {depth, camera} = this.sequence;
    const values = depth.values.at(stored);
    const positions = this.position.array, colors = this.color.array;
    let count = 0;
    for (let row = 0, i = 0; row < depth.rows; ++row) {
      for (let column = 0; column < depth.columns; ++column, ++i) {
        if (values[i] === 0) continue;
        const z = values[i] * depth.step_m;
        positions[3 * count] = (column * depth.every - camera.cx) / camera.fx * z;
        positions[3 * count + 1] = (row * depth.every - camera.cy) / camera.fy * z;
        positions[3 * count + 2] = z;
        const share = (values[i] - this.nearest) / this.span;
        colors.set(this.ramp[Math.round(share * (this.ramp.length - 1))], 3 * count);
        ++count;
      }
    }
    this.geometry.setDrawRange(0, count);
    this.position.needsUpdate = this.color.needsUpdate = true;
  }
}

// Lines from each joint to its parent's, and points at the joints; seen through the body.
class MovingSkeleton {
  // joints: FrameArray; links: pairs of indices into a frame's joints
  constructor(joints, links, color) {
    this.joints = joints;
    this.links = links;
    this.lines = new THREE.BufferGeometry();
    this.lines.setAttribute("position",
                            new THREE.BufferAttribute(new Float32Array(6 * links.length), 3));
    this.points = new THREE.BufferGeometry();
    this.points.setAttribute("position",
                             new THREE.BufferAttribute(new Float32Array(joints.length), 3));
    const look = {color: colorOf(color), depthTest: false, transparent: true};
    this.object = new THREE.Group();
    this.object.add(new THREE.LineSegments(this.lines, new THREE.LineBasicMaterial(look)));
    this.object.add(new THREE.Points(
        this.points, new THREE.PointsMaterial({...look, size: 6, sizeAttenuation: false})));
    for (const part of this.object.children) {
      part.frustumCulled = false;
      part.renderOrder = 2;
    }
  }

  show(frame) {
    const joints = this.joints.at(frame);
    const lines = this.lines.attributes.position, points = this.points.attributes.position;
    points.array.set(joints.map(x => Number.isFinite(x) ? x : 0));
    this.links.forEach(([a, b], i) => {
      const known = Number.isFinite(joints[3 * a]) && Number.isFinite(joints[3 * b]);
      for (let axis = 0; axis < 3; ++axis) {
        lines.array[6 * i + axis] = known ? joints[3 * a + axis] : 0;
        lines.array[6 * i + 3 + axis] = known ? joints[3 * b + axis] : 0;
      }
    });
    lines.needsUpdate = points.needsUpdate = true;
  }
}

// Of each joint the ellipsoid that should hold it in 95 % of cases; seen through the body.
class JointRegions {
  constructor(run, color) {
    this.run = run;
    this.object = new THREE.Group();
    const sphere = new THREE.SphereBufferGeometry(1, 16, 12);
    const material = new THREE.MeshBasicMaterial(
        {color: colorOf(color), depthTest: false, transparent: true, opacity: 0.6});
    for (let joint = 0; joint < run.uncertainty.length / 6; ++joint) {
      const region = new THREE.Mesh(sphere, material);
      region.matrixAutoUpdate = region.frustumCulled = false;
      region.renderOrder = 3;
      this.object.add(region);
    }
  }

  show(frame) {
    const joints = this.run.joints.at(frame), factors = this.run.uncertainty.at(frame);
    this.object.children.forEach((region, joint) => {
      const [a, b, c, d, e, f] = factors.subarray(6 * joint, 6 * joint + 6).map(x => kRegion95 * x);
      const [x, y, z] = joints.subarray(3 * joint, 3 * joint + 3);
      region.visible = Number.isFinite(a);
      region.matrix.set(a, 0, 0, x, b, c, 0, y, d, e, f, z, 0, 0, 0, 1);
      region.matrixWorldNeedsUpdate = true;
    });
  }
}

function frustumOf(camera) {
  const depth = 0.6;  // metres to which it is drawn
  const corner = (u, v) => new THREE.Vector3((u - camera.cx) / camera.fx * depth,
                                             (v - camera.cy) / camera.fy * depth, depth);
  const corners = [corner(0, 0), corner(camera.width, 0), corner(camera.width, camera.height),
                   corner(0, camera.height)];
  const eye = new THREE.Vector3();
  const ends = corners.flatMap((c, i) => [eye, c, c, corners[(i + 1) % 4]]);
  return new THREE.LineSegments(new THREE.BufferGeometry().setFromPoints(ends),
                                new THREE.LineBasicMaterial({color: 0x888888}));
}

// The rest pose, standing to the left of the body's place in the first frame.
function templateOf(run, color) {
  const asideBy = 1.3;  // metres
  const positions = Float32Array.from(run.surface.template.values);
  for (let i = 0; i < positions.length; i += 3) {  // subject frame to camera frame
    positions[i + 1] *= -1;
    positions[i + 2] *= -1;
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
  geometry.setIndex(new THREE.BufferAttribute(run.surface.triangles.values, 1));
  geometry.computeVertexNormals();
  geometry.computeBoundingBox();
  const {grid} = run, firstPositions = run.surface.positions.at(0), body = new THREE.Box3();
  for (let i = 0; i < firstPositions.length; i += 3) {
    body.expandByPoint(new THREE.Vector3().fromArray(firstPositions, i)
                           .multiplyScalar(grid.step_m).add(new THREE.Vector3(...grid.origin)));
  }
  const mesh = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial(
      {color: colorOf(color), side: THREE.DoubleSide}));
  const own = geometry.boundingBox;
  mesh.position.set(body.min.x - asideBy - own.max.x * 0.5, body.max.y - own.max.y,
                    (body.min.z + body.max.z - own.min.z - own.max.z) / 2);
  return mesh;
}

// One run's scene. layers: its objects by name.
class RunScene {
  constructor(page, index, alone) {
    const run = this.run = page.runs[index];
    const sequence = this.sequence = page.sequences[run.sequence];
    this.page = page;
    const palette = page.palette;
    const trueColor = alone ? palette.truth : kTruthBesideRuns;
    const ownColor = alone ? palette.estimate : palette.runs[index % palette.runs.length];
    this.scene = new THREE.Scene();
    this.root = new THREE.Group();
    this.root.rotation.x = Math.PI;
    this.scene.add(this.root);
    this.light = new THREE.DirectionalLight(0xffffff, 0.65);
    this.scene.add(this.light, this.light.target, new THREE.HemisphereLight(0xffffff, 0x777788, 0.6));

    const links = page.bones.map((bone, i) => [i, bone.parent]).filter(link => link[1] >= 0);
    this.ownColor = ownColor;
    this.moving = {
      estimate: new MovingSurface(run.surface, run.grid, ownColor, 1),
      depth: new DepthPoints(sequence, palette.depth),
    };
    this.skeletons = [];
    this.layers = {};
    if (sequence.truth)
      this.moving.truth = new MovingSurface(sequence.truth, sequence.grid, trueColor,
                                            sequence.truth.triangles ? 0.45 : 1);
    for (const name in this.moving) this.layers[name] = this.moving[name].object;
    this.addSkeletons(links, ownColor, trueColor);
    if (run.uncertainty) {
      this.regions = new JointRegions(run, ownColor);
      this.layers.regions = this.regions.object;
    }
    this.layers.frustum = frustumOf(sequence.camera);
    this.layers.template = new THREE.Group();  // filled when it is first shown
    for (const name in this.layers) this.root.add(this.layers[name]);
  }

  addSkeletons(links, ownColor, trueColor) {
    const group = new THREE.Group();
    if (this.run.joints.length > 0)
      this.skeletons.push(new MovingSkeleton(this.run.joints, links, ownColor));
    const truth = this.sequence.joints;
    if (truth) {
      const index = new Map(truth.names.map((name, i) => [name, i]));
      const known = links.map(link => link.map(bone => index.get(this.page.bones[bone].joint)))
                         .filter(link => link.every(i => i !== undefined));
      this.skeletons.push(new MovingSkeleton(truth.positions, known, trueColor));
    }
    for (const skeleton of this.skeletons) group.add(skeleton.object);
    this.layers.skeleton = group;
  }

  // Of a layer: whose stored frames it has, and which of them shows a frame.
  storedOf(name, frame) {
    const {run, sequence} = this;
    const owner = name === "estimate" ? run : sequence;
    return Math.min(storedIndex(owner, Math.min(frame, run.frames - 1)),
                    (name === "estimate" ? run.surface.positions : sequence.depth.values).frames - 1);
  }

  // What must be loaded before show() with the same arguments: pairs of an array and a frame of it.
  needs(frame, layers, colorBy) {
    const needed = [];
    for (const name in this.moving)
      if (layers.has(name)) needed.push(...this.moving[name].needs(this.storedOf(name, frame)));
    const {surface} = this.run;
    const colors = kLengths.has(colorBy) ? surface[colorBy] && surface[colorBy].values
                                         : colorBy === "visible" && surface.visible;
    if (layers.has("estimate") && colors) needed.push([colors, this.storedOf("estimate", frame)]);
    if (layers.has("template") && this.layers.template.children.length === 0)
      needed.push([surface.positions, 0]);
    return needed;
  }

  // Draws anew what is seen and has changed.
  show(frame, layers, colorBy, errorScale_m) {
    if (layers.has("template") && this.layers.template.children.length === 0)
      this.layers.template.add(templateOf(this.run, this.ownColor));
    for (const name in this.moving) {
      const moving = this.moving[name], stored = this.storedOf(name, frame);
      if (!layers.has(name) || moving.shown === stored) continue;
      moving.show(stored);
      moving.shown = stored;
    }
    if (layers.has("skeleton")) {
      for (const skeleton of this.skeletons) skeleton.show(Math.min(frame, this.run.frames - 1));
    }
    if (layers.has("regions") && this.regions)
      this.regions.show(Math.min(frame, this.run.frames - 1));
    const paint = [this.moving.estimate.shown, colorBy, errorScale_m].join();
    if (layers.has("estimate") && this.painted !== paint) {
      this.moving.estimate.paint(this.painter(this.moving.estimate.shown, colorBy, errorScale_m));
      this.painted = paint;
    }
    for (const name in this.layers) this.layers[name].visible = layers.has(name);
  }

  // Null: the surface's own colour.
  painter(stored, colorBy, errorScale_m) {
    const {surface, uncertainty, stored_frames} = this.run, palette = this.page.palette;
    const colorOfLength = length_m => {
      const share = Math.min(1, length_m / errorScale_m), ramp = palette.error;
      return Number.isNaN(share) ? kUnknownColor : ramp[Math.round(share * (ramp.length - 1))];
    };
    if (kLengths.has(colorBy) && surface[colorBy]) {
      const bytes = surface[colorBy].values.at(stored), {most_m} = surface[colorBy];
      const colors = Array.from({length: 256}, (_, b) => colorOfLength((b / 255) ** 2 * most_m));
      return v => colors[bytes[v]];
    }
    if (colorBy === "uncertainty" && uncertainty && surface.bone) {
      const factors = uncertainty.at(stored_frames[stored]);
      const colors = this.page.bones.map((_, bone) =>
          colorOfLength(expectedError_m(factors.subarray(6 * bone, 6 * bone + 6))));
      return v => colors[surface.bone.values[v]] || kUnknownColor;
    }
    if (colorBy === "visible" && surface.visible) {
      const visible = surface.visible.at(stored);
      return v => visible[v] ? kVisibleColor : kHiddenColor;
    }
    if (colorBy === "bone" && surface.bone)
      return v => palette.bones[surface.bone.values[v]] || kUnknownColor;
    return null;
  }
}

// Where the picture is seen from: angles in degrees round a target, in the scenes' frame.
class View {
  constructor(target, distance) {
    this.home = {azimuth: 0, elevation: 0, distance: distance, target: target.clone()};
    this.reset();
  }
  reset() {
    Object.assign(this, this.home, {target: this.home.target.clone()});
  }
  turn(azimuth, elevation) {
    this.azimuth = ((this.azimuth + azimuth + 540) % 360) - 180;
    this.elevation = Math.max(-89, Math.min(89, this.elevation + elevation));
  }
  zoom(factor) {
    this.distance = Math.max(0.2, Math.min(30, this.distance * factor));
  }
  // Rightwards and upwards in the picture, metres.
  pan(right, up) {
    const a = this.azimuth * Math.PI / 180;
    this.target.add(new THREE.Vector3(right * Math.cos(a), up, -right * Math.sin(a)));
  }
  place(camera, shift) {
    const a = this.azimuth * Math.PI / 180, e = this.elevation * Math.PI / 180;
    const target = this.target.clone().add(shift);
    camera.position.set(Math.sin(a) * Math.cos(e), Math.sin(e), Math.cos(a) * Math.cos(e))
        .multiplyScalar(this.distance).add(target);
    camera.lookAt(target);
  }
}

class Stage {
  constructor(canvas, page) {
    this.canvas = canvas;
    this.page = page;
    this.renderer = new THREE.WebGLRenderer({canvas: canvas, antialias: true,
                                             preserveDrawingBuffer: true});
    this.renderer.autoClear = false;
    this.camera = new THREE.PerspectiveCamera();
    this.camera.near = 0.05;
    this.camera.far = 60;
    this.scenes = page.runs.map((_, i) => new RunScene(page, i, page.runs.length === 1));
    this.overlaid = false;
    this.follow = false;
    this.errorScale_m = page.error_scale_m;  // where the colours of errors end
    this.background = new THREE.Color(1, 1, 1);
    this.frame = 0;
    // Views are set round where the body is in the first frame in which it is followed.
    const lost = new Set(page.runs[0].lost);
    const followed = page.runs[0].stored_frames.find(frame => !lost.has(frame));
    this.settled = Promise.resolve();
    this.home = this.pelvis(followed === undefined ? 0 : followed);
    this.view = new View(this.home, 2.9);
  }

  // In the scenes' frame.
  pelvis(frame, index = 0) {
    const run = this.page.runs[index];
    const joints = run.joints.at(Math.min(frame, run.frames - 1));
    if (joints.length >= 3) return new THREE.Vector3(joints[0], -joints[1], -joints[2]);
    const {origin, step_m} = run.grid;
    return new THREE.Vector3(origin[0] + step_m * 32768, -origin[1] - step_m * 32768,
                             -origin[2] - step_m * 32768);
  }

  // Loads what a frame's picture needs.
  load(scenes, frame, layers, colorBy) {
    const missing = scenes.flatMap(scene => scene.needs(frame, layers, colorBy))
                        .filter(([array, stored]) => !array.has(stored));
    return missing.length ? Promise.all(missing.map(([array, stored]) => array.load(stored))) : null;
  }

  // Draws when all is loaded; of several calls that wait, the last. `settled`: a promise of that.
  show(frame, layers, colorBy) {
    const wanted = this.wanted = {frame, layers: new Set(layers), colorBy};
    const loading = this.load(this.scenes, frame, layers, colorBy);
    if (!loading) return this.showLoaded(wanted);
    this.settled = loading.then(() => {
      if (this.wanted === wanted) this.show(frame, layers, colorBy);
    });
  }

  // What comes next while the body moves.
  prefetch(frame) {
    if (this.wanted) this.load(this.scenes, frame, this.wanted.layers, this.wanted.colorBy);
  }

  showLoaded({frame, layers, colorBy}) {
    this.frame = frame;
    this.scenes.forEach((scene, i) => {
      scene.show(frame, layers, colorBy, this.errorScale_m);
      const shared = this.overlaid && i > 0 &&
                     this.page.runs[i].sequence === this.page.runs[0].sequence;
      if (!shared) return;
      for (const name of ["truth", "depth", "frustum"])
        if (scene.layers[name]) scene.layers[name].visible = false;
    });
    this.draw();
  }

  // A small picture of one run's frame, as a data address. What is seen stays as it is.
  async picture(run, frame, layers, colorBy) {
    const size = 144, finer = 2, side = size * finer, scene = this.scenes[run];
    const target = this.smallTarget = this.smallTarget || new THREE.WebGLRenderTarget(side, side);
    await this.load([scene], frame, layers, colorBy);
    scene.show(frame, layers, colorBy, this.errorScale_m);
    this.camera.aspect = 1;
    this.camera.fov = 2 * Math.atan(kHalfAngleTangent) * 180 / Math.PI;
    this.camera.updateProjectionMatrix();
    this.view.place(this.camera, this.pelvis(frame, run).sub(this.home));
    this.renderer.setRenderTarget(target);
    this.renderer.setScissorTest(false);
    this.renderer.setClearColor(this.background);
    this.renderer.clear();
    this.render(scene);
    const pixels = new Uint8ClampedArray(4 * side * side);
    this.renderer.readRenderTargetPixels(target, 0, 0, side, side, pixels);
    this.renderer.setRenderTarget(null);
    return smallPicture(pixels, side, size);
  }

  render(scene) {
    scene.light.position.copy(this.camera.position);
    scene.light.target.position.copy(this.camera.position).addScaledVector(
        this.camera.getWorldDirection(new THREE.Vector3()), this.view.distance);
    this.renderer.render(scene.scene, this.camera);
  }

  draw() {
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (width === 0 || height === 0) return;
    const ratio = Math.min(devicePixelRatio || 1, 2);
    if (this.width !== width || this.height !== height || this.ratio !== ratio) {
      this.renderer.setPixelRatio(ratio);
      this.renderer.setSize(width, height, false);
      Object.assign(this, {width, height, ratio});
    }
    const panes = this.overlaid ? 1 : this.scenes.length;
    const aspect = this.camera.aspect = width / panes / height;
    const halfAngle = Math.atan(kHalfAngleTangent / Math.min(1, aspect));  // a narrow pane is as wide
    this.camera.fov = 2 * halfAngle * 180 / Math.PI;
    this.camera.updateProjectionMatrix();
    const shift = this.follow ? this.pelvis(this.frame).sub(this.home) : new THREE.Vector3();
    this.view.place(this.camera, shift);
    this.renderer.setScissorTest(true);
    this.renderer.setClearColor(this.background);
    this.scenes.forEach((scene, i) => {
      const left = this.overlaid ? 0 : Math.round(width * i / panes);
      const right = this.overlaid ? width : Math.round(width * (i + 1) / panes);
      this.renderer.setViewport(left, 0, right - left, height);
      this.renderer.setScissor(left, 0, right - left, height);
      if (i === 0 || !this.overlaid) this.renderer.clear();
      this.render(scene);
    });
  }
}

// Square pixels, the bottom row first, as a smaller picture's data address.
function smallPicture(pixels, side, size) {
  const large = document.createElement("canvas"), small = document.createElement("canvas");
  large.width = large.height = side;
  small.width = small.height = size;
  large.getContext("2d").putImageData(new ImageData(pixels, side, side), 0, 0);
  const pen = small.getContext("2d");
  pen.imageSmoothingQuality = "high";
  pen.setTransform(1, 0, 0, -1, 0, size);
  pen.drawImage(large, 0, 0, size, size);
  return small.toDataURL("image/png");
}

// Pointer and wheel: drag turns, drag with Shift or the right button moves, wheel and pinch zoom.
// changed() is called after each.
function steerByPointer(stage, changed) {
  const canvas = stage.canvas, view = stage.view, pointers = new Map();
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  canvas.addEventListener("pointerdown", event => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
  });
  canvas.addEventListener("pointermove", event => {
    const last = pointers.get(event.pointerId);
    if (!last) return;
    const before = pointers.size === 2 ? spread() : 0;
    const dx = event.clientX - last.x, dy = event.clientY - last.y;
    pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
    if (pointers.size === 2) {
      view.zoom(before / Math.max(1, spread()));
    } else if (event.shiftKey || event.buttons & 2) {
      const metres = 2 * kHalfAngleTangent * view.distance / canvas.clientHeight;  // of a pixel
      view.pan(-dx * metres, dy * metres);
    } else {
      view.turn(-dx * 0.4, dy * 0.4);
    }
    changed();
  });
  for (const end of ["pointerup", "pointercancel"])
    canvas.addEventListener(end, event => pointers.delete(event.pointerId));
  canvas.addEventListener("contextmenu", event => event.preventDefault());
  canvas.addEventListener("wheel", event => {
    event.preventDefault();
    view.zoom(Math.exp(event.deltaY * 0.001));
    changed();
  }, {passive: false});
}
