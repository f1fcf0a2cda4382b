// What is selected and shown, and who wants to know. The curves are the document's; the rest is the browser's alone.

import { byName, curveOf, unpack } from "./data.js";

// how much more what varies along a curve tells of a row than the rest
const FREE = 30;

/** Return the row of a curve computed anew for one of it as it was: the same special point, or the same load. */
function sameRow(before, row, now) {
  const label = before.special.get(row)?.label,
    same = now.specials.find((s) => s.label === label);
  if (label && same) return same.row;
  const far = new Float64Array(now.rows);
  for (const [name, values] of Object.entries(now.columns)) {
    const there = before.columns[name]?.[row];
    if (!Number.isFinite(there)) continue;
    const finite = values.filter(Number.isFinite),
      range = finite.reduce((a, v) => Math.max(a, v), -Infinity) - finite.reduce((a, v) => Math.min(a, v), Infinity);
    const weight = name in now.free ? FREE : 1;
    if (range > 0)
      for (let i = 0; i < now.rows; i++) far[i] += (weight * Math.min(1, Math.abs(values[i] - there) / range)) ** 2;
  }
  return Math.max(0, far.indexOf(Math.min(...far)));
}

export class Store {
  constructor(document) {
    this.listeners = new Map();
    this.timings = [];
    this.left = new Map();
    this.live = false;
    this.running = false;
    this.canUndo = false;
    this.replace(document);
  }

  /** Take another document; the selection stays where its curve does. */
  replace(document) {
    const before = this.curve,
      row = this.row;
    this.document = document;
    this.quantities = byName(document.quantities);
    this.curves = document.curves.map(curveOf);
    const start = this.curves.find((c) => c.id === before?.id) ?? this.curves.find((c) => c.rows) ?? null;
    this.curve = start;
    this.row = !start ? 0 : before?.id === start.id ? sameRow(before, row, start) : this.rowOf(start);
    this.sample = 0;
  }

  /** Add a curve, or put it in the place of the one with its id; `quantities` are those it brings. */
  put(raw, quantities = {}) {
    const curve = curveOf(raw),
      k = this.curves.findIndex((c) => c.id === curve.id);
    this.quantities = this.document.quantities = byName({ ...quantities, ...this.quantities });
    const raws = this.document.curves;
    if (k < 0) {
      this.curves.push(curve);
      raws.push(raw);
    } else {
      this.curves[k] = curve;
      raws[k] = raw;
      if (this.curve?.id === curve.id) [this.curve, this.row] = [curve, Math.min(this.row, curve.rows - 1)];
    }
    this.curve ??= curve;
    this.tell("curves");
    return curve;
  }

  /** Take the eigenvalues of a curve that came without. */
  complete(id, eigenvalues) {
    const curve = this.curves.find((c) => c.id === id),
      raw = this.document.curves.find((c) => c.id === id);
    if (!curve) return;
    raw.eigenvalues = eigenvalues;
    curve.eigenvalues = unpack(eigenvalues);
    if (curve === this.curve) this.tell("spectra");
  }

  on(event, listener) {
    if (!this.listeners.has(event)) this.listeners.set(event, []);
    this.listeners.get(event).push(listener);
  }

  tell(event, detail) {
    for (const listener of this.listeners.get(event) ?? []) listener(detail);
  }

  /** Select a row; how long that takes, drawing aside, is kept for who measures it. */
  select(curve, row, sample = 0) {
    if (!curve?.rows) return;
    const begun = performance.now(),
      other = curve !== this.curve;
    const now = Math.max(0, Math.min(curve.rows - 1, row));
    if (other && this.curve) this.left.set(this.curve.id, this.row);
    if (!other && now === this.row && sample === this.sample) return;
    [this.curve, this.row, this.sample] = [curve, now, sample];
    if (other) this.tell("curve");
    this.tell("row");
    this.timings.push(performance.now() - begun);
    if (this.timings.length > 1000) this.timings.shift();
  }

  /** Return the row of a curve at which it was left, or its start. */
  rowOf(curve) {
    return Math.min(this.left.get(curve.id) ?? curve.start ?? 0, curve.rows - 1);
  }

  /** Return the special point of the row, if it is one. */
  get special() {
    return this.curve?.special.get(this.row) ?? null;
  }

  curvesOf(...kinds) {
    return this.curves.filter((c) => kinds.includes(c.kind));
  }
}
