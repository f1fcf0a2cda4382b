// Curves of special points in two parameters.

import { Drag } from "./drag.js";
import { linesOf, pointsOf } from "./diagram.js";
import { Plot } from "./plot.js";

export class Locus {
  constructor(panel, store) {
    Object.assign(this, { panel, store, lines: [] });
    this.plot = new Plot(panel.body, "Curves of special points in two parameters");
    this.drag = new Drag(
      this.plot,
      () => this.lines,
      (curve, row) => store.select(curve, row),
      () => store.curve,
    );
    for (const event of ["curves", "curve"]) store.on(event, () => this.draw());
    store.on("row", () => this.mark());
    this.draw();
  }

  draw() {
    const every = this.store.curvesOf("locus");
    this.panel.show(every.length > 0);
    if (!every.length) return;
    const { curve, quantities } = this.store,
      chosen = curve?.kind === "locus" ? curve : every[0],
      [x, y] = chosen.axes;
    const curves = every.filter((c) => c.columns[x] && c.columns[y]);
    this.lines = curves.flatMap((c) => linesOf(c, x, y, quantities, curves.length > 1 && c !== curve ? "other" : ""));
    this.plot.draw({
      x: { quantity: quantities[x], name: x, kind: "log" },
      y: { quantity: quantities[y], name: y, kind: "log" },
      lines: this.lines,
      points: pointsOf(this.lines, chosen),
    });
    this.mark();
  }

  mark() {
    const { curve, row } = this.store,
      l = this.lines.find((line) => line.curve === curve);
    this.plot.place(l ? [l.xs[row], l.ys[row]] : null);
  }
}
