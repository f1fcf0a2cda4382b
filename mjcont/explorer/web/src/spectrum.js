// Eigenvalues of the row, or Floquet multipliers about the unit circle.

import { eigenvaluesOf, JUMPING } from "./data.js";
import { s } from "./dom.js";
import { Plot } from "./plot.js";

const DOT = "M-3.6,0A3.6,3.6 0 1,0 3.6,0A3.6,3.6 0 1,0 -3.6,0Z";
const TRIANGLE = "M0,-5.5L5,3.8H-5Z";
// how far out a multiplier is shown where it is
const MOST = 5;
const PARTS = [
  ["Re", 0],
  ["Im", 1],
];

export class Spectrum {
  constructor(panel, store) {
    Object.assign(this, { panel, store, dots: [] });
    this.plot = new Plot(panel.body, "Eigenvalues of the selected row", false);
    for (const event of ["curves", "curve", "spectra"]) store.on(event, () => this.begin());
    store.on("row", () => this.mark());
    this.begin();
  }

  /** Take axes that hold the eigenvalues of all rows, so that dots move and axes do not. */
  begin() {
    const { curve } = this.store,
      circle = Boolean(curve?.multipliers);
    this.panel.show(Boolean(this.store.curves.some((c) => c.eigenvalues)));
    this.panel.title(circle ? "Floquet multipliers" : "Eigenvalues");
    const unit = circle ? "" : "1/s";
    const axis = ([word, part]) => ({
      quantity: { label: [[word, "", ""]], unit },
      name: word,
      kind: circle ? "linear" : "symlog",
      extent: circle ? aboutCircle(curve.eigenvalues) : extentOfPart(curve?.eigenvalues, part),
      typical: circle ? 0 : typicalOfPart(curve?.eigenvalues, part),
    });
    const [x, y] = PARTS.map(axis);
    this.plot.draw({ x, y, lines: [], equal: circle, over: (plot, layer) => this.background(plot, layer) });
  }

  /** Draw what stands still: the side, or the circle, beyond which is unstable. */
  background(plot, layer) {
    const [, y0, x1, y1] = plot.inner,
      [cx, cy] = [plot.x(0), plot.y(0)];
    const side = { class: "unstable-side", x: cx, y: y0, width: Math.max(0, x1 - cx), height: y1 - y0 };
    const circle = { class: "axis-line", cx, cy, rx: Math.abs(plot.x(1) - cx), ry: Math.abs(plot.y(1) - cy) };
    layer.append(this.store.curve?.multipliers ? s("ellipse", circle) : s("rect", side));
    this.dots = [];
    this.mark();
  }

  /** Put the dots where the eigenvalues of the row are; those that are there already are moved. */
  mark() {
    const { curve, row } = this.store,
      { plot } = this;
    if (!curve || !plot.x) return;
    const [x0, y0, x1, y1] = plot.inner,
      found = eigenvaluesOf(curve, row),
      unstable = curve.unstable?.[row] ?? 0;
    const size = curve.multipliers ? (v) => Math.hypot(...v) : (v) => v[0];
    found.sort((a, b) => size(b) - size(a));
    while (this.dots.length < found.length) this.dots.push(plot.layers.over.appendChild(s("path")));
    for (const [k, dot] of this.dots.entries()) {
      const v = found[k];
      dot.style.display = v ? "" : "none";
      if (!v) continue;
      const bad = k < unstable && size(v) > (curve.multipliers ? 1 : 0);
      const px = Math.min(Math.max(plot.x(v[0]), x0), x1),
        py = Math.min(Math.max(plot.y(v[1]), y0), y1);
      if (dot.dataset.bad !== String(bad)) {
        dot.dataset.bad = bad;
        dot.setAttribute("class", bad ? "eigen unstable" : "eigen");
        dot.setAttribute("d", bad ? TRIANGLE : DOT);
      }
      dot.setAttribute("transform", `translate(${px.toFixed(1)},${py.toFixed(1)})`);
    }
    this.tell(curve, row, found.length, unstable);
  }

  /** Say what is seen, or why nothing is. */
  tell(curve, row, count, unstable) {
    const moving = curve.kind === "history" || curve.stability?.[row] === JUMPING;
    this.panel.say(count ? "" : moving ? "none in motion" : "not computed here");
    const words = `${curve.multipliers ? "Multipliers" : "Eigenvalues"} of the row: ${count}, ${unstable} unstable`;
    if (words === this.told) return;
    this.told = words;
    this.plot.svg.setAttribute("aria-label", words);
  }
}

/** Return the axes' extent for multipliers: the unit circle, and those outside as far as they can be shown with it. */
function aboutCircle(table) {
  const far = Math.min(MOST, Math.max(1.35, ...[0, 1].flatMap((part) => extentOfPart(table, part).map(Math.abs))));
  return [-far, far];
}

/** Return the middle one of the sizes of a part that are not nothing. */
function typicalOfPart(table, part) {
  const sizes = [];
  for (
    let i = part, step = 2 * Math.max(1, Math.floor((table?.length ?? 0) / 4000));
    i < (table?.length ?? 0);
    i += step
  )
    if (Math.abs(table[i]) > 1e-9) sizes.push(Math.abs(table[i]));
  return sizes.sort((a, b) => a - b)[Math.floor(sizes.length / 2)] ?? 0;
}

function extentOfPart(table, part) {
  let low = -1,
    high = 1;
  for (let i = part; i < (table?.length ?? 0); i += 2) {
    if (table[i] < low) low = table[i];
    if (table[i] > high) high = table[i];
  }
  return [low, high];
}
