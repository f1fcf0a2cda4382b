// The bifurcation diagram: branches by stability, orbits by their extremes, load paths as broad lines.

import { columnOf, drawnColumns, runsOf, STABILITY } from "./data.js";
import { h, s, select } from "./dom.js";
import { Drag } from "./drag.js";
import { keyOf } from "./key.js";
import { Plot } from "./plot.js";
import { plainName } from "./words.js";

const LABELLED = 4;
const KINDS = ["loadpath", "branch", "orbits"];

/** Return the values of a column as shown. */
export function scaled(values, quantity) {
  const scale = quantity?.scale ?? 1;
  if (scale === 1) return values;
  const found = new Float64Array(values.length);
  for (let i = 0; i < values.length; i++) found[i] = scale * values[i];
  return found;
}

/** Return lines of a curve for two names; `key` tells them apart. */
export function linesOf(curve, x, y, quantities, cls = "") {
  const xs = columnOf(curve, x);
  if (!xs) return [];
  const runs = runsOf(curve).map((r) => ({ ...r, cls: r.code === null ? "" : STABILITY[r.code] }));
  return drawnColumns(curve, y).map((ys, k) => ({
    xs: scaled(xs, quantities[x]),
    ys: scaled(ys, quantities[y] ?? quantities[`${y}.max`]),
    runs,
    curve,
    cls: `${curve.kind} ${cls}`,
    key: `${curve.id}/${k}`,
    snaps: true,
    turn: turning(ys, quantities[y]),
  }));
}

function turning(ys, quantity) {
  return quantity?.si === "rad" ? (i) => i > 0 && Math.abs(ys[i] - ys[i - 1]) > Math.PI : null;
}

/** Return the special points of lines; where curves are many, labels are those of the selected one. */
export function pointsOf(lines, selected) {
  const found = [];
  const many = new Set(lines.map((l) => l.curve)).size > LABELLED;
  // a load path counts its jumps its own way: beside curves whose folds have names, theirs are the names
  const named = lines.some((l) => l.curve.kind !== "loadpath" && l.curve.specials.length);
  for (const l of lines)
    for (const p of l.curve.specials) {
      if (p.kind === "EP") continue;
      const told = l.key.endsWith("/0") && (!many || l.curve === selected) && !(named && l.curve.kind === "loadpath");
      found.push({
        x: l.xs[p.row],
        y: l.ys[p.row],
        label: told ? p.label : "",
        kind: p.kind,
        name: p.name.replace(/^jump at /, ""),
        cls: l.curve === selected ? "" : "faint",
      });
    }
  return found;
}

export class Diagram {
  constructor(panel, store) {
    Object.assign(this, { panel, store, lines: [] });
    this.plot = new Plot(panel.body, "Bifurcation diagram");
    this.drag = new Drag(
      this.plot,
      () => this.lines,
      (curve, row) => store.select(curve, row),
      () => store.curve,
    );
    store.on("curves", () => this.draw());
    store.on("curve", () => this.turn());
    store.on("row", () => this.mark());
    store.on("partial", (curve) => this.grow(curve));
    this.draw();
  }

  /** Return the curves in the order in which they are drawn: load paths lie below. */
  get curves() {
    return KINDS.flatMap((kind) => this.store.curvesOf(kind));
  }

  /** Take the axes of the first curve, and offer all columns. */
  choose() {
    const first = this.store.curvesOf(...KINDS)[0];
    if (!first) return;
    this.axes ??= { x: first.axes[0], y: first.axes[1] };
    this.offer();
    this.draw();
  }

  /** Take the axes of a curve that is selected where it would be a line straight up, or none. */
  turn() {
    const { curve } = this.store,
      own = this.axes && KINDS.includes(curve?.kind);
    const [x, y] = own ? [curve.columns[this.axes.x], drawnColumns(curve, this.axes.y).length] : [true, true];
    if (!x || !y) {
      this.axes = { x: x ? this.axes.x : curve.axes[0], y: y ? this.axes.y : curve.axes[1] };
      this.plot.resetZoom();
      this.offer();
    }
    this.draw();
  }

  offer() {
    const names = new Set(),
      { quantities } = this.store;
    for (const c of this.curves) {
      for (const n of Object.keys(c.columns)) names.add(n);
      if (c.kind === "orbits")
        for (const n of Object.keys(c.orbit?.columns ?? {})) if (c.columns[`${n}.max`]) names.add(n);
    }
    this.offered = [...names].join();
    const options = [...names].map((n) => [n, plainName(quantities[n], n)]);
    const pick = (way) => (value) => {
      this.axes[way] = value;
      this.plot.resetZoom();
      this.draw();
      this.store.tell("axes");
    };
    this.panel.tools.replaceChildren(
      h("label", {}, "y ", select("Vertical axis of the diagram", options, this.axes.y, pick("y"))),
      h("label", {}, "x ", select("Horizontal axis of the diagram", options, this.axes.x, pick("x"))),
    );
  }

  draw() {
    const curves = this.curves;
    this.panel.show(curves.length > 0);
    if (!curves.length) return undefined;
    if (!this.axes) return this.choose();
    const { x, y } = this.axes,
      { quantities, curve } = this.store;
    if (curves.some((c) => Object.keys(c.columns).some((n) => !`,${this.offered},`.includes(`,${n},`)))) this.offer();
    const many = curves.length > 1;
    this.lines = curves.flatMap((c) => linesOf(c, x, y, quantities, many && c !== curve ? "other" : ""));
    this.lines.push(...this.moving());
    const points = pointsOf(this.lines, curve);
    this.panel.foot.replaceChildren(...keyOf(this.lines, points));
    this.plot.draw({
      x: { quantity: quantities[x], name: x, kind: "log" },
      y: { quantity: quantities[y] ?? quantities[`${y}.max`], name: y, kind: "log" },
      lines: this.lines,
      points,
    });
    this.mark();
    return undefined;
  }

  /** Draw what there is of a curve that is still being computed; null takes it away. */
  grow(curve) {
    const { x, y } = this.axes ?? {},
      { quantities } = this.store,
      xs = curve?.columns[x],
      ys = curve?.columns[y];
    const layer = this.plot.layers.over;
    if (!xs || !ys || !this.plot.x) return layer.replaceChildren();
    const ways = curve.columns.direction;
    const [px, py] = [this.plot.x, this.plot.y].map((scale, k) => {
      const factor = quantities[k ? y : x]?.scale ?? 1;
      return Array.from(k ? ys : xs, (v) => scale(v * factor).toFixed(1));
    });
    const pen = (i) => (i === 0 || (ways && ways[i] !== ways[i - 1]) ? "M" : "L");
    const parts = px.map((v, i) => `${pen(i)}${v},${py[i]}`);
    return layer.replaceChildren(s("path", { class: "line growing", d: parts.join("") }));
  }

  /** Return the lines of a history that is selected: how a motion goes over the diagram. */
  moving() {
    const { curve, quantities } = this.store,
      { x, y } = this.axes;
    return curve?.kind === "history" ? linesOf(curve, x, y, quantities, "moving") : [];
  }

  mark() {
    const { curve, row } = this.store,
      l = this.lines.find((line) => line.curve === curve);
    this.plot.place(l ? [l.xs[row], l.ys[row]] : null);
  }
}
