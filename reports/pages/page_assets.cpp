#include "reports/pages/page_assets.h"

namespace vitruvia {

const char* const kPageStyle = R"css(
:root { color-scheme: light dark; --paper: #fff; --ink: #1d2125; --soft: #5a636b; --line: #dde1e4;
        --band: #f5f6f7; --accent: #005a8f; --good: #00664b; --bad: #a3001d; }
@media screen and (prefers-color-scheme: dark) {
  :root { --paper: #15181b; --ink: #e4e7ea; --soft: #a3acb4; --line: #3a4148; --band: #1f2428;
          --accent: #7cc0ec; --good: #6fd0a8; --bad: #ff8d9d; }
  figure.plot svg { border-radius: .3rem; }
}
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; }
body { margin: 0 auto; padding: 1.5rem 1.25rem 4rem; max-width: 1240px; color: var(--ink);
       background: var(--paper); font: 16px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "Noto Sans",
       "DejaVu Sans", sans-serif; font-variant-numeric: tabular-nums; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: .2rem 0 .5rem; letter-spacing: -.01em; }
h2 { font-size: 1.35rem; margin: 2.8rem 0 .6rem; padding-top: .6rem; border-top: 2px solid var(--ink); }
h3 { font-size: 1.05rem; margin: 1.6rem 0 .4rem; }
h4 { font-size: .95rem; font-weight: 600; margin: 1.1rem 0 .4rem; }
p { margin: .4rem 0 .8rem; max-width: 75ch; }
.soft, figcaption { color: var(--soft); }
.kicker { color: var(--soft); font-size: .9rem; margin: 0; }
nav { display: flex; flex-wrap: wrap; gap: .3rem 1.2rem; padding: .6rem 0; font-size: .95rem; }
a { color: var(--accent); }
code, .run { font: .86em/1.4 ui-monospace, "SF Mono", Menlo, Consolas, "DejaVu Sans Mono", monospace; }
.run { overflow-wrap: anywhere; }
td.run { white-space: nowrap; overflow-wrap: normal; }
.scroll { overflow-x: auto; -webkit-overflow-scrolling: touch; }
table { border-collapse: collapse; font-size: .92rem; min-width: 100%; }
th, td { padding: .38rem .7rem; text-align: left; vertical-align: baseline;
         border-bottom: 1px solid var(--line); }
td.n, th.n { text-align: right; white-space: nowrap; }
thead th { font-weight: 600; border-bottom: 2px solid var(--ink); vertical-align: bottom; }
tr.group th { background: var(--band); font-weight: 600; padding-top: .7rem; }
tr.group small { display: block; font-weight: 400; color: var(--soft); font-size: .88rem; }
.variants th.n { white-space: normal; }
.variants small { display: block; font-size: .82em; font-weight: 400; }
tr.total td { font-weight: 600; border-top: 2px solid var(--ink); }
td.problem { color: var(--bad); overflow-wrap: anywhere; }
.verdict { white-space: nowrap; font-weight: 600; }
.verdict.met { color: var(--good); }
.verdict.missed, .verdict.none { color: var(--bad); }
th button { font: inherit; color: inherit; background: none; border: 0; padding: 0; cursor: pointer;
            text-align: inherit; }
th button:hover { color: var(--accent); text-decoration: underline; }
th[aria-sort=ascending] button::after { content: " ▲"; }
th[aria-sort=descending] button::after { content: " ▼"; }
figure { margin: 1.2rem 0 0; }
figcaption { font-size: .92rem; max-width: 80ch; }
figcaption b { color: var(--ink); font-size: 1.02rem; display: block; }
figure.plot svg { display: block; width: 100%; min-width: 540px; max-width: 900px; height: auto;
                  margin-top: .4rem; }
.cells { display: grid; gap: .5rem; grid-template-columns: repeat(7, minmax(0, 1fr)); }
.cells.few { grid-template-columns: repeat(auto-fill, minmax(min(100%, 220px), 290px)); }
.cells figure { margin: 0; }
.cells img { display: block; width: 100%; height: auto; border: 1px solid var(--line); }
.cells figcaption { font-size: .78rem; line-height: 1.3; padding-top: .2rem; }
.cards { display: grid; gap: 1.2rem 1.6rem; grid-template-columns: repeat(auto-fill, minmax(min(100%, 34rem), 1fr)); }
.card { border-top: 2px solid var(--line); min-width: 0; }
.card h3 { margin: .6rem 0 .2rem; }
.card img { display: block; max-width: 100%; height: auto; }
.card figure.plot svg { min-width: 0; }
b.met { color: var(--good); }
b.missed { color: var(--bad); }
p.problem { color: var(--bad); }
#hint { position: absolute; z-index: 1; max-width: 22rem; padding: .25rem .5rem; font-size: .85rem;
        color: var(--ink); background: var(--band); border: 1px solid var(--line); border-radius: .25rem;
        pointer-events: none; overflow-wrap: anywhere; }
#hint[hidden] { display: none; }
svg circle:focus { outline: 2px solid var(--accent); }
:focus-visible { outline: 2px solid var(--accent); outline-offset: 1px; }
.choose { display: flex; flex-wrap: wrap; gap: .4rem 1rem; align-items: center; margin: .4rem 0; }
.choose button { font: inherit; color: inherit; background: var(--band); border: 1px solid var(--line);
                 border-radius: .25rem; padding: .2rem .7rem; }
.events { display: grid; gap: .7rem; padding: 0; list-style: none; margin: .5rem 0;
          grid-template-columns: repeat(auto-fill, minmax(min(100%, 15rem), 1fr)); }
.events li { display: grid; grid-template-columns: 5rem minmax(0, 1fr); gap: .6rem; font-size: .85rem; }
.events img { width: 5rem; height: 5rem; border: 1px solid var(--line); }
.events b { display: block; }
.bars { display: flex; flex-wrap: wrap; gap: .6rem 2rem; margin: .4rem 0 .6rem; font-size: .85rem; }
.bar { width: 300px; max-width: 100%; }
.bar i { display: block; height: 12px; border: 1px solid var(--line); }
.bar span { display: flex; justify-content: space-between; }
.key { display: inline-block; width: .8em; height: .8em; margin-right: .35em; }
details { border-bottom: 1px solid var(--line); padding: .35rem 0; }
summary { cursor: pointer; padding: .15rem 0; }
details pre { background: var(--band); padding: .8rem; overflow-x: auto; font-size: .8rem; }
dl { display: grid; grid-template-columns: max-content minmax(0, 1fr); gap: .2rem 1rem; font-size: .9rem; }
dt { color: var(--soft); }
dd { margin: 0; overflow-wrap: anywhere; }
@media (max-width: 900px) { .cells { grid-template-columns: repeat(4, minmax(0, 1fr)); } }
@media (max-width: 560px) {
  body { padding: 1rem .9rem 3rem; font-size: 15px; }
  h1 { font-size: 1.5rem; }
  .cells { grid-template-columns: repeat(2, minmax(0, 1fr)); }
  th, td { padding: .35rem .45rem; }
  table { font-size: .85rem; }
  dl { grid-template-columns: minmax(0, 1fr); gap: 0; }
  dd { margin-bottom: .4rem; }
  .compare, .compare tbody { display: block; }
  .compare thead { display: none; }
  .compare tr { display: grid; grid-template-columns: repeat(4, minmax(0, 1fr));
                border-bottom: 1px solid var(--line); padding: .3rem 0; }
  .compare th, .compare td { border: 0; padding: .1rem .3rem; text-align: left; }
  .compare .run, .compare tr.group th { grid-column: 1 / -1; white-space: normal; overflow-wrap: anywhere; }
  .compare tr.group { background: var(--band); }
  .compare .problem { grid-column: span 2; }
  .compare td.verdict { grid-column: 1 / -1; }
  .variants, .variants tbody { display: block; }
  .variants thead { display: none; }
  .variants tr { display: grid; grid-template-columns: repeat(2, minmax(0, 1fr));
                 border-bottom: 1px solid var(--line); padding: .4rem 0; }
  .variants td { border: 0; padding: .1rem .2rem; text-align: left; white-space: normal; }
  .variants td.run { grid-column: 1 / -1; font-weight: 600; white-space: normal;
                     overflow-wrap: anywhere; }
  .papers, .papers tbody { display: block; }
  .papers thead { display: none; }
  .papers tr { display: grid; grid-template-columns: repeat(3, minmax(0, 1fr));
               border-bottom: 1px solid var(--line); padding: .5rem 0; }
  .papers td { grid-column: 1 / -1; border: 0; padding: .05rem .2rem; text-align: left; }
  .papers td:first-child { font-weight: 600; }
  .papers td[data-label] { grid-column: auto; white-space: normal; }
  .papers td[data-label]::before, .compare td[data-label]::before,
  .variants td[data-label]::before { content: attr(data-label); display: block; color: var(--soft);
                                    font-size: .82em; }
}
@media print {
  body { max-width: none; padding: 0; font-size: 10pt; }
  nav { display: none; }
  .scroll { overflow: visible; }
  figure, .strip, .card, tr { break-inside: avoid; }
  figure.plot svg { min-width: 0; }
  .sortable { font-size: 5.5pt; }
  .variants { font-size: 7.5pt; }
  .sortable th, .sortable td { padding: 1pt 1.5pt; white-space: normal; overflow-wrap: anywhere; }
  h2, h3, h4 { break-after: avoid; }
  .cells { grid-template-columns: repeat(7, minmax(0, 1fr)); }
  #hint, .choose { display: none; }
  * { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
}
)css";

const char* const kPageScript = R"js(
for (const table of document.querySelectorAll("table.sortable")) {
  table.querySelectorAll("thead button").forEach((button, column) => {
    button.addEventListener("click", () => {
      const header = button.parentElement;
      const down = header.getAttribute("aria-sort") === "ascending";
      for (const other of header.parentElement.children) other.removeAttribute("aria-sort");
      header.setAttribute("aria-sort", down ? "descending" : "ascending");
      const body = table.tBodies[0];
      const value = row => row.cells[column] ? row.cells[column].dataset.value : undefined;
      const order = (a, b) => {
        if (value(a) === undefined || value(b) === undefined)
          return (value(a) === undefined) - (value(b) === undefined);
        const x = Number(value(a)), y = Number(value(b));
        const by = Number.isNaN(x) || Number.isNaN(y) ? value(a).localeCompare(value(b)) : x - y;
        return down ? -by : by;
      };
      body.append(...[...body.rows].sort(order));
    });
  });
}

// What a plot says of the point or curve under the pointer, or of the point that has the focus.
const hint = document.createElement("div");
hint.id = "hint";
hint.hidden = true;
document.body.append(hint);
function say(text, x, y) {
  hint.textContent = text;
  hint.hidden = false;
  hint.style.left = Math.min(x + 12, innerWidth - hint.offsetWidth - 8) + scrollX + "px";
  hint.style.top = y + 14 + scrollY + "px";
}
function nearestOn(svg, x, y) {
  const matrix = svg.getScreenCTM(), reach = 14;
  let best = {distance: reach};
  for (const curve of svg.querySelectorAll("[data-values]")) {
    const values = curve.dataset.values.split(",");
    [...curve.points].forEach((point, i) => {
      const at = point.matrixTransform(matrix), distance = Math.hypot(at.x - x, at.y - y);
      if (distance < best.distance) best = {distance, curve, value: values[i]};
    });
  }
  if (!best.curve) return "";
  const [of, value] = best.value.split(" ");
  return `${best.curve.dataset.name} · ${value} at ${of}`;
}
for (const svg of document.querySelectorAll("figure.plot svg")) {
  svg.addEventListener("pointermove", event => {
    const text = event.target.ariaLabel && event.target !== svg ? event.target.ariaLabel
                                                               : nearestOn(svg, event.clientX, event.clientY);
    if (text) say(text, event.clientX, event.clientY); else hint.hidden = true;
  });
  svg.addEventListener("pointerleave", () => hint.hidden = true);
  svg.addEventListener("focusin", event => {
    const box = event.target.getBoundingClientRect();
    if (event.target.ariaLabel) say(event.target.ariaLabel, box.right, box.top);
  });
  svg.addEventListener("focusout", () => hint.hidden = true);
}
addEventListener("keydown", event => { if (event.key === "Escape") hint.hidden = true; });

// Runs that are chosen in a table open in lockstep: the page of the first takes in the others.
for (const box of document.querySelectorAll(".choose")) {
  const table = box.parentElement.querySelector("table"), button = box.querySelector("button");
  const chosen = () => [...table.querySelectorAll("input:checked")].map(input => input.value);
  table.addEventListener("input", () => button.disabled = chosen().length < 2);
  button.disabled = true;
  button.addEventListener("click", () => {
    const [first, ...others] = chosen();
    const up = "../".repeat(first.split("/").length - 1), address = new URLSearchParams();
    for (const other of others) address.append("with", up + other);
    open(first + "#" + address, "_blank");
  });
}
addEventListener("beforeprint", () => document.querySelectorAll("details").forEach(d => d.open = true));
)js";

}  // namespace vitruvia
