"use strict";
// A number of each frame over time, one line for each run. A click jumps to the frame.

class Timeline {
  // jumped(frame) is called while the pointer is down.
  constructor(canvas, page, jumped) {
    this.canvas = canvas;
    this.page = page;
    this.options = {difference: false, logarithmic: false};
    const jump = event => {
      const box = canvas.getBoundingClientRect();
      const share = (event.clientX - box.left - this.left) / (box.width - this.left - this.right);
      jumped(Math.round(Math.max(0, Math.min(1, share)) * (page.frames - 1)));
    };
    canvas.addEventListener("pointerdown", event => {
      canvas.setPointerCapture(event.pointerId);
      jump(event);
    });
    canvas.addEventListener("pointermove", event => { if (event.buttons & 1) jump(event); });
  }
  left = 54;
  right = 12;

  // What is drawn: [{values, color, name}].
  lines(series) {
    const {page, options} = this;
    const has = series.values.map((values, run) => ({values, run})).filter(line => line.values);
    if (!options.difference || has.length < 2) {
      return has.map(({values, run}) => ({values, color: page.palette.runs[run % 7],
                                          name: page.runs[run].id}));
    }
    const first = has[0];
    return has.slice(1).map(({values, run}) => ({
      values: values.map((value, frame) => value - first.values[frame]),
      color: page.palette.runs[run % 7], name: page.runs[run].id + " − " + page.runs[first.run].id}));
  }

  draw(series, frame) {
    const canvas = this.canvas, ratio = devicePixelRatio || 1;
    const width = canvas.clientWidth, height = canvas.clientHeight;
    if (width === 0) return;
    canvas.width = width * ratio;
    canvas.height = height * ratio;
    const pen = canvas.getContext("2d");
    const style = getComputedStyle(canvas);
    const ink = style.getPropertyValue("--ink"), soft = style.getPropertyValue("--soft");
    pen.scale(ratio, ratio);
    pen.font = "12px system-ui, sans-serif";
    const plot = {left: this.left, top: 8, width: width - this.left - this.right,
                  height: height - 34};
    const last = Math.max(1, this.page.frames - 1);
    const x = f => plot.left + f / last * plot.width;
    this.drawEvents(pen, plot, x);
    const lines = this.lines(series);
    const logarithmic = this.options.logarithmic && !this.options.difference;
    const level = value => logarithmic ? (value > 0 ? Math.log10(value) : NaN) : value;
    const [low, high] = this.range(lines, level);
    const y = value => plot.top + (high - level(value)) / (high - low) * plot.height;

    pen.fillStyle = soft;
    pen.strokeStyle = soft;
    pen.textAlign = "right";
    pen.textBaseline = "middle";
    for (const end of [low, (low + high) / 2, high]) {
      const text = shortNumber(logarithmic ? 10 ** end : end);
      const at = plot.top + (high - end) / (high - low) * plot.height;
      pen.fillText(text, plot.left - 6, at);
      pen.globalAlpha = 0.25;
      pen.beginPath();
      pen.moveTo(plot.left, at);
      pen.lineTo(plot.left + plot.width, at);
      pen.stroke();
      pen.globalAlpha = 1;
    }
    pen.textBaseline = "alphabetic";
    pen.textAlign = "left";
    pen.fillText("frame 0", plot.left, height - 5);
    pen.textAlign = "right";
    pen.fillText(String(this.page.frames - 1), plot.left + plot.width, height - 5);
    for (const line of lines) this.drawLine(pen, line, x, y);
    pen.strokeStyle = ink;
    pen.lineWidth = 1.5;
    pen.beginPath();
    pen.moveTo(x(frame), plot.top - 4);
    pen.lineTo(x(frame), plot.top + plot.height + 4);
    pen.stroke();
  }

  range(lines, level) {
    let low = Infinity, high = -Infinity;
    for (const line of lines) {
      for (const value of line.values) {
        const at = level(value);
        if (!Number.isFinite(at)) continue;
        if (at < low) low = at;
        if (at > high) high = at;
      }
    }
    if (low > high) return [0, 1];
    if (!this.options.logarithmic && low > 0 && !this.options.difference) low = 0;
    return low === high ? [low - 0.5, high + 0.5] : [low, high];
  }

  drawLine(pen, line, x, y) {
    pen.strokeStyle = `rgb(${line.color})`;
    pen.lineWidth = 1.4;
    pen.beginPath();
    let drawing = false;
    line.values.forEach((value, frame) => {
      const at = y(value);
      if (!Number.isFinite(at)) {
        drawing = false;
        return;
      }
      if (drawing) pen.lineTo(x(frame), at); else pen.moveTo(x(frame), at);
      drawing = true;
    });
    pen.stroke();
  }

  // Lost frames as bars, the worst events as ticks below.
  drawEvents(pen, plot, x) {
    const half = Math.max(0.5, plot.width / this.page.frames / 2);
    this.page.runs.forEach((run, r) => {
      pen.fillStyle = `rgb(${this.page.palette.failure})`;
      pen.globalAlpha = 0.22;
      for (const frame of run.lost)
        pen.fillRect(x(frame) - half, plot.top, 2 * half, plot.height);
      pen.globalAlpha = 1;
      pen.fillStyle = `rgb(${this.page.palette.runs[r % 7]})`;
      for (const event of run.events) {
        pen.beginPath();
        pen.moveTo(x(event.worst), plot.top + plot.height + 1);
        pen.lineTo(x(event.worst) - 4, plot.top + plot.height + 8);
        pen.lineTo(x(event.worst) + 4, plot.top + plot.height + 8);
        pen.fill();
      }
    });
  }
}

function shortNumber(value) {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size >= 1e5 || size > 0 && size < 1e-2) return value.toExponential(1);
  return String(Number(value.toPrecision(3)));
}
