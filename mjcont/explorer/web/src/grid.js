// A point over a grid of parameters, and energy barriers along a branch.

import { columnOf } from "./data.js";
import { linesOf, scaled } from "./diagram.js";
import { s } from "./dom.js";
import { Drag } from "./drag.js";
import { Plot } from "./plot.js";
import { extentOf } from "./scales.js";
import { plainName, shown } from "./words.js";

const LOW = [214, 230, 247],
  HIGH = [9, 66, 128];

export class Grid {
  constructor(panel, store) {
    Object.assign(this, { panel, store, lines: [] });
    this.plot = new Plot(panel.body, "A point over parameters, or energy barriers");
    this.drag = new Drag(
      this.plot,
      () => this.lines,
      (curve, row) => store.select(curve, row),
    );
    for (const event of ["curves", "curve"]) store.on(event, () => this.draw());
    store.on("row", () => this.mark());
    this.draw();
  }

  draw() {
    const every = this.store.curvesOf("map", "barriers");
    this.panel.show(every.length > 0);
    if (!every.length) return;
    const { curve, quantities } = this.store;
    const now = every.includes(curve) ? curve : every.at(-1);
    const flat = now.kind === "map" && Object.keys(now.grid).length > 1;
    this.panel.title(now.kind === "map" ? this.titled(now, flat) : "Energy barrier");
    const [x, y] = flat ? Object.keys(now.grid) : now.kind === "map" ? [Object.keys(now.grid)[0], now.shown] : now.axes;
    this.lines = flat ? [this.nodes(now, x, y)] : linesOf(now, x, y, quantities, "plain");
    if (now.kind === "barriers") this.lines.forEach((l) => (l.runs = piecesOf(now.pieces)));
    this.plot.draw({
      x: { quantity: quantities[x], name: x, extent: flat ? cellsOf(this.lines[0].xs) : null },
      y: { quantity: quantities[y], name: y, extent: flat ? cellsOf(this.lines[0].ys) : null },
      lines: this.lines,
      points: [],
      over: flat ? (plot, layer) => this.cells(plot, layer, now) : null,
    });
    this.mark();
  }

  /** Return what a map shows, and of which values light and dark are. */
  titled(now, flat) {
    const quantity = this.store.quantities[now.shown],
      name = `${now.point}: ${plainName(quantity, now.shown)}`;
    const ends = extentOf([columnOf(now, now.shown)]);
    return flat && ends ? `${name}, ${shown(ends[0], quantity, 4)} (light) to ${shown(ends[1], quantity, 4)}` : name;
  }

  /** Return the nodes of a map over two parameters as a line that is not drawn. */
  nodes(now, x, y) {
    const { quantities } = this.store;
    const [xs, ys] = [x, y].map((n) => scaled(columnOf(now, n), quantities[n]));
    return { xs, ys, runs: [], curve: now, key: now.id };
  }

  cells(plot, layer, now) {
    const values = columnOf(now, now.shown),
      [low, high] = extentOf([values]) ?? [0, 1],
      [l] = this.lines,
      quantity = this.store.quantities[now.shown];
    const [wide, high1] = [plot.x, plot.y].map((scale, k) => cellSize(scale, k ? l.ys : l.xs));
    for (let i = 0; i < values.length; i++) {
      const t = (values[i] - low) / (high - low || 1),
        colour = LOW.map((a, k) => Math.round(a + t * (HIGH[k] - a)));
      const cell = s("rect", {
        x: plot.x(l.xs[i]) - wide / 2,
        y: plot.y(l.ys[i]) - high1 / 2,
        width: wide - 1,
        height: high1 - 1,
        fill: `rgb(${colour.join()})`,
        class: "cell",
      });
      const title = s("title");
      title.textContent = shown(values[i], quantity, 5);
      cell.append(title);
      layer.append(cell);
    }
  }

  mark() {
    const { curve, row } = this.store,
      l = this.lines.find((line) => line.curve === curve);
    this.plot.place(l ? [l.xs[row], l.ys[row]] : null);
  }
}

/** Return an extent that holds the cells about values, from edge to edge. */
function cellsOf(values) {
  const places = [...new Set(values)].sort((a, b) => a - b);
  const half = places.length > 1 ? 0.5 * Math.min(...places.slice(1).map((p, i) => p - places[i])) : 0.5;
  return [places[0] - half, places.at(-1) + half];
}

function cellSize(scale, values) {
  const places = [...new Set(values)].map((v) => scale(v)).sort((a, b) => a - b);
  const steps = places.slice(1).map((p, i) => p - places[i]);
  return steps.length ? Math.min(...steps) : 40;
}

function piecesOf(pieces) {
  const runs = [];
  for (let i = 0; i < pieces.length; i++)
    if (!runs.length || pieces[i] !== pieces[i - 1]) runs.push({ first: i, last: i });
    else runs.at(-1).last = i;
  return runs;
}
