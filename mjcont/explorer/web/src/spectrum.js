// Eigenvalues of the row, or Floquet multipliers about the unit circle.

import { eigenvaluesOf, JUMPING } from "./data.js";
import { s } from "./dom.js";
import { Plot } from "./plot.js";

const PARTS = [
  ["Re", 0],
  ["Im", 1],
];

export class Spectrum {
  constructor(panel, store) {
    Object.assign(this, { panel, store });
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
      extent: circle ? [-1.35, 1.35] : extentOfPart(curve?.eigenvalues, part),
      typical: circle ? 0 : typicalOfPart(curve?.eigenvalues, part),
    });
    const [x, y] = PARTS.map(axis);
    this.plot.draw({ x, y, lines: [], equal: circle, over: (plot, layer) => this.dots(plot, layer) });
  }

  mark() {
    this.plot.layers.over.textContent = "";
    this.dots(this.plot, this.plot.layers.over);
  }

  dots(plot, layer) {
    const { curve, row } = this.store;
    if (!curve || !plot.x) return;
    const [x0, y0, x1, y1] = plot.inner;
    if (curve.multipliers) {
      const rx = Math.abs(plot.x(1) - plot.x(0)),
        ry = Math.abs(plot.y(1) - plot.y(0));
      layer.append(s("ellipse", { class: "axis-line", cx: plot.x(0), cy: plot.y(0), rx, ry }));
    } else
      layer.append(
        s("rect", { class: "unstable-side", x: plot.x(0), y: y0, width: Math.max(0, x1 - plot.x(0)), height: y1 - y0 }),
      );
    const unstable = curve.unstable?.[row] ?? 0,
      found = eigenvaluesOf(curve, row);
    const moving = curve.kind === "history" || curve.stability?.[row] === JUMPING;
    this.panel.say(found.length ? "" : moving ? "none in motion" : "not computed here");
    const size = (v) => (curve.multipliers ? Math.hypot(...v) : v[0]);
    found.sort((a, b) => size(b) - size(a));
    for (const [k, v] of found.entries()) {
      const px = Math.min(Math.max(plot.x(v[0]), x0), x1),
        py = Math.min(Math.max(plot.y(v[1]), y0), y1);
      const bad = curve.multipliers ? size(v) > 1 + 1e-6 && k < unstable + 2 : k < unstable && v[0] > 0;
      layer.append(
        bad
          ? s("path", { class: "eigen unstable", d: `M${px},${py - 5.5}L${px + 5},${py + 3.8}H${px - 5}Z` })
          : s("circle", { class: "eigen", cx: px, cy: py, r: 3.6 }),
      );
    }
    this.plot.svg.setAttribute(
      "aria-label",
      found.length
        ? `${curve.multipliers ? "Multipliers" : "Eigenvalues"} of the row: ${found.length}, ${unstable} unstable`
        : "The eigenvalues of the selected row are not known",
    );
  }
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
