"use strict";
// State, controls and keys. The state stands in the address, so that a link opens what is seen.

const kLayers = [
  ["estimate", "estimate"], ["truth", "truth"], ["depth", "depth points"], ["skeleton", "skeleton"],
  ["template", "template"], ["frustum", "camera"], ["regions", "95 % regions of the joints"],
];
const kColors = [
  ["error", "error"], ["visible", "visible or hidden"], ["bone", "bone"],
  ["warp", "warp: distance from the skinned template"],
  ["uncertainty", "predicted error of the bone’s joint"], ["plain", "plain"],
];
// Colours on the scale of lengths, as the legend names them.
const kScaled = {error: "error", warp: "warp", uncertainty: "predicted error"};
const kPrefetch = 32;  // frames that are unpacked ahead while the body moves
const element = id => document.getElementById(id);

function percent(share) {
  return (100 * share).toFixed(share < 0.1 ? 1 : 0) + " %";
}

class Viewer {
  // others: addresses of pages whose runs stand beside this one's
  constructor(page, others) {
    this.page = page;
    this.others = others;
    this.fps = page.sequences[page.runs[0].sequence].fps;
    this.state = {frame: 0, layers: new Set(["estimate", "depth"]), color: "plain", series: "",
                  layout: "beside", speed: 1, scale_mm: 1e3 * page.error_scale_m, follow: false, difference: false, logarithmic: false};
    this.playing = false;
    this.makeControls();
    this.stage = new Stage(element("stage"), page);
    this.timeline = new Timeline(element("timeline"), page, frame => this.go(frame));
    this.readAddress();
    this.listen();
    this.draw();
    setTimeout(() => this.drawEventPictures(), 100);
  }

  // When what was asked for is drawn.
  async settled() {
    await new Promise(drawn => requestAnimationFrame(() => requestAnimationFrame(drawn)));
    await this.stage.settled;
  }

  // What some run of the page has.
  available() {
    const {page} = this;
    const some = has => page.runs.some(has);
    return {
      layers: {estimate: true, depth: true, frustum: true, template: true, skeleton: true,
               truth: page.sequences.some(sequence => sequence.truth),
               regions: some(run => run.uncertainty)},
      colors: {plain: true, error: some(run => run.surface.error),
               warp: some(run => run.surface.warp),
               uncertainty: some(run => run.uncertainty && run.surface.bone),
               visible: some(run => run.surface.visible), bone: some(run => run.surface.bone)},
    };
  }

  makeControls() {
    const {page, state} = this;
    const available = this.available();
    element("title").textContent = page.runs.map(run => run.id).join(" · ");
    element("notes").textContent = page.notes.join(" ");
    const add = (place, type, name, [value, label], usable) => {
      const line = document.createElement("label"), input = document.createElement("input");
      Object.assign(input, {type, name, value, disabled: !usable});
      line.append(input, " " + label + (usable ? "" : " (not in this page)"));
      element(place).append(line);
    };
    for (const layer of kLayers) add("layers", "checkbox", "layer", layer, available.layers[layer[0]]);
    for (const color of kColors) add("colors", "radio", "color", color, available.colors[color[0]]);
    if (available.colors.error) state.color = "error";
    for (const [key, series] of page.series) {
      const unit = series.unit ? ` (${series.unit})` : "";
      element("series").append(new Option(series.label + unit, key));
    }
    const preferred = ["l2_mean_m", "two_way_mean_m", "joint_error_mean_m", "fit_mean_m", "frame_ms"];
    state.series = preferred.find(key => page.series.has(key)) || [...page.series.keys()][0];
    element("scrub").max = element("frame").max = page.frames - 1;
    const several = page.runs.length > 1;
    element("layout").hidden = !several;
    element("difference-choice").hidden = !several;
    element("panes").replaceChildren(...page.runs.map((run, i) => {
      const pane = document.createElement("div"), name = document.createElement("b");
      name.textContent = run.id;
      pane.style.setProperty("--run", `rgb(${page.palette.runs[i % 7]})`);
      if (several) pane.append(name, document.createElement("br"));
      pane.append(document.createElement("span"));
      return pane;
    }));
    this.listEvents();
  }

  // Worst events with their causes, and how much of the error each cause holds.
  listEvents() {
    this.eventPictures = [];
    this.page.runs.forEach((run, r) => {
      const title = document.createElement("h2"), list = document.createElement("ol");
      title.textContent = this.page.runs.length > 1 ? "Worst events: " + run.id : "Worst events";
      for (const event of run.events) {
        const item = document.createElement("li"), button = document.createElement("button");
        const picture = document.createElement("img"), what = document.createElement("b");
        const detail = document.createElement("small");
        button.type = "button";
        picture.alt = `frame ${event.worst}`;
        what.textContent = event.cause;
        detail.textContent = `frames ${event.first}–${event.last}, ${percent(event.share)} of the error; ` +
                             event.reason;
        button.append(picture, what, detail);
        button.addEventListener("click", () => this.go(event.worst));
        item.append(button);
        list.append(item);
        this.eventPictures.push({picture, run: r, frame: event.worst});
      }
      if (run.events.length === 0) list.textContent = "None: the sequence has no true joints.";
      element("events").append(title);
      if (run.causes.length > 0) element("events").append(this.causeTable(run));
      element("events").append(list);
    });
  }

  // One picture in each idle moment.
  async drawEventPictures() {
    for (; this.eventPictures.length > 0; await new Promise(idle => setTimeout(idle, 0))) {
      const {picture, run, frame} = this.eventPictures[0];
      picture.src = await this.stage.picture(run, frame, new Set(["estimate", "truth"]), this.state.color);
      this.eventPictures.shift();
    }
    this.update();
  }

  causeTable(run) {
    const table = document.createElement("table");
    table.createCaption().textContent = "Share of the run’s total error";
    for (const cause of run.causes) {
      const row = table.insertRow();
      row.insertCell().textContent = cause.name;
      row.title = cause.meaning;
      row.insertCell().textContent = percent(cause.share);
    }
    return table;
  }

  listen() {
    const {state} = this;
    const change = (id, apply) => element(id).addEventListener("input", event => {
      apply(event.target);
      this.update();
    });
    element("play").addEventListener("click", () => this.play(!this.playing));
    element("back").addEventListener("click", () => this.go(state.frame - 1));
    element("forth").addEventListener("click", () => this.go(state.frame + 1));
    element("worst").addEventListener("click", event => this.next(this.worstFrames(), event.shiftKey));
    element("lost").addEventListener("click", event => this.next(this.lostFrames(), event.shiftKey));
    element("copy").addEventListener("click", () => this.copyLink());
    element("scrub").addEventListener("input", event => this.go(Number(event.target.value)));
    element("frame").addEventListener("change", event => this.go(Number(event.target.value)));
    change("speed", input => state.speed = Number(input.value));
    change("scale", input => { if (Number(input.value) > 0) state.scale_mm = Number(input.value); });
    change("series", input => state.series = input.value);
    change("difference", input => state.difference = input.checked);
    change("logarithmic", input => state.logarithmic = input.checked);
    change("follow", input => state.follow = input.checked);
    change("layout", input => state.layout = input.value);
    change("colors", input => state.color = input.value);
    change("layers", input => {
      if (input.checked) state.layers.add(input.value); else state.layers.delete(input.value);
    });
    element("reset").addEventListener("click", () => { this.stage.view.reset(); this.update(); });
    for (const button of document.querySelectorAll("[data-turn]")) {
      button.addEventListener("click", () => {
        const [azimuth, elevation] = button.dataset.turn.split(" ").map(Number);
        Object.assign(this.stage.view, {azimuth, elevation});
        this.update();
      });
    }
    steerByPointer(this.stage, () => this.update());
    addEventListener("keydown", event => this.press(event));
    addEventListener("resize", () => this.update());
    addEventListener("hashchange", () => { this.readAddress(); this.update(); });
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.update());
  }

  press(event) {
    const inField = /^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName);
    const {state, stage} = this;
    if (event.ctrlKey || event.metaKey) return;
    const step = event.shiftKey ? 10 : 1;
    const turns = {ArrowLeft: [10, 0], ArrowRight: [-10, 0], ArrowUp: [0, 10], ArrowDown: [0, -10]};
    if (event.altKey) {
      if (!turns[event.key]) return;
      stage.view.turn(...turns[event.key]);
      event.preventDefault();
      return this.update();
    }
    const keys = {
      ArrowLeft: () => this.go(state.frame - step),
      ArrowRight: () => this.go(state.frame + step),
      Home: () => this.go(0),
      End: () => this.go(this.page.frames - 1),
      w: () => this.next(this.worstFrames(), event.shiftKey),
      l: () => this.next(this.lostFrames(), event.shiftKey),
      c: () => this.choose("color", kColors, this.available().colors),
      n: () => this.nextSeries(),
      o: () => this.page.runs.length > 1 && (state.layout = state.layout === "over" ? "beside" : "over"),
      "<": () => this.changeSpeed(-1),
      ">": () => this.changeSpeed(1),
      "+": () => stage.view.zoom(0.85),
      "-": () => stage.view.zoom(1 / 0.85),
      r: () => stage.view.reset(),
      " ": () => this.play(!this.playing),
    };
    kLayers.forEach(([layer], i) => keys[i + 1] = () => {
      if (!this.available().layers[layer]) return;
      if (!state.layers.delete(layer)) state.layers.add(layer);
    });
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const onButton = event.target.tagName === "BUTTON" && key === " ";
    if (inField && event.target.type !== "checkbox" && event.target.type !== "radio" || onButton) return;
    if (inField && (key === " " || key.startsWith("Arrow"))) return;
    if (!keys[key]) return;
    keys[key]();
    event.preventDefault();
    this.update();
  }

  choose(name, options, usable) {
    const names = options.map(option => option[0]).filter(option => usable[option]);
    this.state[name] = names[(names.indexOf(this.state[name]) + 1) % names.length];
  }

  nextSeries() {
    const keys = [...this.page.series.keys()];
    this.state.series = keys[(keys.indexOf(this.state.series) + 1) % keys.length];
  }

  changeSpeed(by) {
    const select = element("speed");
    select.selectedIndex = Math.max(0, Math.min(select.length - 1, select.selectedIndex + by));
    this.state.speed = Number(select.value);
  }

  go(frame) {
    if (!Number.isFinite(frame)) return;
    this.state.frame = Math.max(0, Math.min(this.page.frames - 1, Math.round(frame)));
    this.update();
  }

  // In order of time. Events where the run was diagnosed, else where the chosen number is largest.
  worstFrames() {
    const events = this.page.runs.flatMap(run => run.events);
    if (events.length) return [...new Set(events.map(event => event.worst))].sort((a, b) => a - b);
    const values = this.page.series.get(this.state.series).values.find(of => of);
    const around = Math.max(1, Math.round(this.fps / 2));
    const peaks = [];
    values.forEach((value, i) => {
      const near = values.subarray(Math.max(0, i - around), i + around + 1);
      if (near.every(other => !(other > value))) peaks.push(i);
    });
    return peaks.sort((a, b) => values[b] - values[a]).slice(0, 10).sort((a, b) => a - b);
  }

  // The first frame of each stretch of lost frames.
  lostFrames() {
    const lost = new Set(this.page.runs.flatMap(run => run.lost));
    return [...lost].filter(frame => !lost.has(frame - 1)).sort((a, b) => a - b);
  }

  next(frames, backwards) {
    if (frames.length === 0) return this.say("There is none.");
    const {frame} = this.state;
    const found = backwards ? frames.filter(f => f < frame).pop() ?? frames[frames.length - 1]
                            : frames.find(f => f > frame) ?? frames[0];
    this.go(found);
    this.say("Frame " + found);
  }

  play(on) {
    this.playing = on;
    element("play").textContent = on ? "Stop" : "Play";
    if (!on) return this.update();
    let last = performance.now(), passed = 0;
    const tick = now => {
      if (!this.playing) return;
      passed += (now - last) / 1e3 * this.fps * this.state.speed;
      last = now;
      const steps = Math.floor(passed);
      passed -= steps;
      if (steps > 0) {
        this.go((this.state.frame + steps) % this.page.frames);
        this.stage.prefetch(Math.min(this.state.frame + kPrefetch, this.page.frames - 1));
      }
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  say(text) {
    element("said").textContent = text;
  }

  // Draws at most once for each frame of the screen.
  update() {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => {
      this.pending = false;
      this.draw();
    });
  }

  draw() {
    const {state, stage, page} = this;
    stage.background.set(getComputedStyle(element("stage")).getPropertyValue("--stage").trim());
    stage.overlaid = state.layout === "over";
    stage.follow = state.follow;
    stage.errorScale_m = 1e-3 * state.scale_mm;
    stage.show(state.frame, state.layers, state.color);
    Object.assign(this.timeline.options,
                  {difference: state.difference, logarithmic: state.logarithmic});
    this.timeline.draw(page.series.get(state.series), state.frame);
    this.showControls();
    this.showValues();
    this.showLegend();
    if (!this.playing) this.writeAddress();
  }

  showControls() {
    const {state} = this;
    element("scrub").value = state.frame;
    if (document.activeElement !== element("frame")) element("frame").value = state.frame;
    element("series").value = state.series;
    element("speed").value = state.speed;
    if (document.activeElement !== element("scale")) element("scale").value = shortNumber(state.scale_mm);
    element("scale-choice").hidden = !kScaled[state.color];
    element("follow").checked = state.follow;
    element("difference").checked = state.difference;
    element("logarithmic").checked = state.logarithmic;
    element("panes").className = state.layout;
    for (const input of document.querySelectorAll("[name=layer]"))
      input.checked = state.layers.has(input.value);
    for (const name of ["color", "layout"]) {
      for (const input of document.querySelectorAll(`[name=${name}]`))
        input.checked = input.value === state[name];
    }
  }

  showValues() {
    const {page, state} = this;
    const series = page.series.get(state.series);
    const lines = this.timeline.lines(series).map(line => {
      const span = document.createElement("span");
      span.style.setProperty("--run", `rgb(${line.color})`);
      const value = state.frame < line.values.length ? line.values[state.frame] : NaN;
      span.textContent = `${line.name}: ${shortNumber(value)} ${series.unit}`;
      return span;
    });
    const what = document.createElement("p");
    what.className = "soft";
    what.textContent = series.definition;
    element("values").replaceChildren(...lines, what);
    const time = (state.frame / this.fps).toFixed(2);
    page.runs.forEach((run, i) => {
      const stored = run.stored_frames[storedIndex(run, Math.min(state.frame, run.frames - 1))];
      const parts = [`frame ${state.frame}, ${time} s`];
      if (state.frame >= run.frames) parts.push(`the run ended at frame ${run.frames - 1}`);
      else if (stored !== state.frame) parts.push(`surface of frame ${stored}`);
      if (run.outcomes[state.frame]) parts.push(run.outcomes[state.frame]);
      element("panes").children[i].lastChild.textContent = parts.join(" · ");
    });
  }

  showLegend() {
    const {palette, bones} = this.page;
    const legend = element("legend");
    const key = (rgb, text) => {
      const part = document.createElement("span"), swatch = document.createElement("span");
      swatch.className = "key";
      swatch.style.background = `rgb(${rgb})`;
      part.append(swatch, text);
      return part;
    };
    const parts = [];
    if (kScaled[this.state.color]) {
      const bar = document.createElement("i"), ends = document.createElement("div");
      bar.style.background = `linear-gradient(to right, ${palette.error.map(c => `rgb(${c})`)})`;
      ends.className = "ends";
      for (const text of ["0", kScaled[this.state.color], `≥ ${shortNumber(this.state.scale_mm)} mm`]) {
        const end = document.createElement("span");
        end.textContent = text;
        ends.append(end);
      }
      parts.push(bar, ends);
    } else if (this.state.color === "visible") {
      parts.push(key(kVisibleColor, "visible"), key(kHiddenColor, "hidden"));
    } else if (this.state.color === "bone") {
      parts.push(...bones.map((bone, i) => key(palette.bones[i], bone.name.replaceAll("_", " "))));
    }
    if (this.state.layers.has("truth") && this.available().layers.truth)
      parts.push(key(this.page.runs.length > 1 ? kTruthBesideRuns : palette.truth, "truth"));
    legend.replaceChildren(...parts);
  }

  writeAddress() {
    const {state} = this, view = this.stage.view;
    const numbers = [view.azimuth, view.elevation, view.distance, ...view.target.toArray()];
    const entries = {frame: state.frame, layers: [...state.layers].join(" "), color: state.color,
                     series: state.series, layout: state.layout, speed: state.speed,
                     scale: state.scale_mm,
                     view: numbers.map(x => Number(x.toFixed(3))).join(" ")};
    for (const flag of ["follow", "difference", "logarithmic"]) if (state[flag]) entries[flag] = 1;
    const address = new URLSearchParams(entries);
    for (const other of this.others) address.append("with", other);
    this.address = "#" + address;
    if (this.address !== location.hash) history.replaceState(null, "", this.address);
  }

  readAddress() {
    if (location.hash === this.address) return;
    const {state} = this, view = this.stage.view, entries = new URLSearchParams(location.hash.slice(1));
    const frame = Number(entries.get("frame"));
    if (Number.isInteger(frame)) state.frame = Math.max(0, Math.min(this.page.frames - 1, frame));
    const known = (name, options) => {
      if (options.includes(entries.get(name))) state[name] = entries.get(name);
    };
    known("color", Object.entries(this.available().colors).filter(c => c[1]).map(c => c[0]));
    known("series", [...this.page.series.keys()]);
    known("layout", ["beside", "over"]);
    if (Number(entries.get("speed")) > 0) state.speed = Number(entries.get("speed"));
    if (Number(entries.get("scale")) > 0) state.scale_mm = Number(entries.get("scale"));
    if (entries.has("layers"))
      state.layers = new Set(entries.get("layers").split(" ").filter(
          name => kLayers.some(layer => layer[0] === name)));
    for (const flag of ["follow", "difference", "logarithmic"]) state[flag] = entries.has(flag);
    const numbers = (entries.get("view") || "").split(" ").map(Number);
    if (numbers.length === 6 && numbers.every(Number.isFinite)) {
      [view.azimuth, view.elevation, view.distance] = numbers;
      view.target.fromArray(numbers, 3);
    }
  }

  async copyLink() {
    this.writeAddress();
    try {
      await navigator.clipboard.writeText(location.href);
      this.say("The link is copied.");
      element("copy").textContent = "Copied";
      setTimeout(() => element("copy").textContent = "Copy link", 1500);
    } catch {
      prompt("The link:", location.href);
    }
  }
}

async function open() {
  if (isAsked()) return give();
  const others = new URLSearchParams(location.hash.slice(1)).getAll("with");
  try {
    const page = await loadPage(others);
    element("shown").hidden = false;
    window.viewer = new Viewer(page, others);
    await window.viewer.stage.settled;
    element("loading").remove();
    window.viewer.openedAfter_ms = performance.now();  // since the page was asked for
  } catch (error) {
    element("loading").className = "problem";
    element("loading").textContent = "The page cannot be shown: " + error.message +
        ". It needs a browser of 2023 or later with WebGL.";
    throw error;
  }
}
open();
