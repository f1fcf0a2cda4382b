// What happens in time: a history, or one period of the orbit of the row.

import { orbitAt } from "./data.js";
import { scaled } from "./diagram.js";
import { h, select } from "./dom.js";
import { Drag } from "./drag.js";
import { Plot } from "./plot.js";
import { plainName } from "./words.js";

export class Motion {
  constructor(panel, store) {
    Object.assign(this, { panel, store, lines: [], name: null });
    this.plot = new Plot(panel.body, "Motion in time");
    this.drag = new Drag(
      this.plot,
      () => this.lines,
      (curve, i) => (curve.orbit ? store.select(curve, store.row, i) : store.select(curve, i)),
    );
    for (const event of ["curves", "curve"]) store.on(event, () => this.draw());
    store.on("row", () => (this.stale() ? this.draw() : this.mark()));
    this.draw();
  }

  /** Return the curve that moves: the selected one, or the last that does. */
  get moving() {
    const moves = (c) => c && (c.kind === "history" || c.orbit);
    return moves(this.store.curve) ? this.store.curve : this.store.curves.findLast(moves);
  }

  stale() {
    const { curve, row } = this.store;
    return Boolean(curve?.orbit) && (curve !== this.drawn || orbitAt(curve, row) !== this.orbit);
  }

  draw() {
    const curve = this.moving;
    this.panel.show(Boolean(curve));
    if (!curve) return;
    const { quantities } = this.store,
      names = Object.keys(curve.orbit ? curve.orbit.columns : curve.columns).filter((n) => n !== "time");
    if (!names.includes(this.name))
      this.name = curve.orbit ? (names.includes(curve.axes[1]) ? curve.axes[1] : names[0]) : curve.axes[1];
    this.panel.title(curve.orbit ? "One period" : curve.name);
    this.panel.tools.replaceChildren(
      h(
        "label",
        {},
        "y ",
        select(
          "Vertical axis over time",
          names.map((n) => [n, plainName(quantities[n], n)]),
          this.name,
          (value) => {
            this.name = value;
            this.draw();
          },
        ),
      ),
    );
    const { xs, ys } = curve.orbit ? this.period(curve) : { xs: curve.columns.time, ys: curve.columns[this.name] };
    this.drawn = curve;
    const quantity = quantities[this.name];
    this.lines = [
      { xs, ys: scaled(ys, quantity), runs: [{ first: 0, last: xs.length - 1 }], cls: "time", key: curve.id, curve },
    ];
    this.plot.draw({
      x: { quantity: { label: [["time", "", ""]], unit: "s" }, name: "time" },
      y: { quantity, name: this.name },
      lines: this.lines,
    });
    this.mark();
  }

  period(curve) {
    const k = orbitAt(curve, this.store.curve === curve ? this.store.row : 0),
      all = curve.orbit.columns[this.name],
      n = all.shape[1];
    this.orbit = k;
    const xs = Float64Array.from({ length: n }, (_, i) => (curve.orbit.period[k] * i) / (n - 1));
    return { xs, ys: all.subarray(k * n, (k + 1) * n) };
  }

  mark() {
    const { curve, row, sample } = this.store,
      [l] = this.lines;
    const i = curve?.orbit ? sample : row;
    this.plot.place(l && l.curve === curve ? [l.xs[i], l.ys[i]] : null);
  }
}
