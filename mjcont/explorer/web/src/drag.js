// Dragging along a curve: the pointer takes the row near it that is also near along the curve, so that a drag goes
// through a fold and not across it.

const WINDOW = 60;
// of places that a press may mean: how near, in pixels, a special point is, or the curve that is selected
const NEAR = 9;
// how near a pointer is to what it is told of
const HINTED = 24;

export class Drag {
  /** `lines()` returns lines with px, py and their `curve`; `moved(curve, row)` is told, `selected()` asked. */
  constructor(plot, lines, moved, selected = () => null) {
    Object.assign(this, { plot, lines, moved, selected, held: null });
    const svg = plot.svg;
    svg.addEventListener("pointerdown", (e) => this.down(e));
    svg.addEventListener("pointermove", (e) => (this.held ? this.move(e) : this.hover(e)));
    svg.addEventListener("pointerleave", () => plot.hint(null));
    for (const name of ["pointerup", "pointercancel", "lostpointercapture"])
      svg.addEventListener(name, () => this.up());
  }

  down(event) {
    if (event.button !== 0 || event.shiftKey || !event.isPrimary) return;
    const [x, y] = this.plot.where(event);
    const best = this.meant(x, y);
    if (!best) return;
    this.plot.svg.setPointerCapture(event.pointerId);
    this.plot.hint(null);
    this.held = { line: best.line, row: best.row, at: [x, y] };
    this.moved(best.line.curve, best.row);
    event.preventDefault();
  }

  /** Return the line and the row that a press means. */
  meant(x, y) {
    let best = null;
    for (const line of this.lines()) {
      const found = nearest(line, x, y, 0, line.px.length - 1);
      if (!found) continue;
      const own = line.curve === this.selected() && found.far < NEAR ** 2;
      if (!best || own || (!best.own && found.far <= best.far)) best = { ...found, line, own };
      if (own) break;
    }
    if (!best || !best.line.curve.specials) return best;
    const far = (p) => (best.line.px[p.row] - x) ** 2 + (best.line.py[p.row] - y) ** 2;
    const special = best.line.curve.specials.filter((p) => far(p) < NEAR ** 2).sort((a, b) => far(a) - far(b))[0];
    return special && best.line.snaps ? { ...best, row: special.row } : best;
  }

  /** Say what is under a pointer that presses nothing. */
  hover(event) {
    if (event.pointerType === "touch") return;
    const [x, y] = this.plot.where(event),
      found = this.meant(x, y);
    if (!found) return;
    const { line, row } = found,
      far = Math.hypot(line.px[row] - x, line.py[row] - y);
    this.plot.hint(far < HINTED ? { line, row } : null);
  }

  move(event) {
    const [x, y] = this.plot.where(event),
      { at, row } = this.held;
    // a new drawing has new lines
    const line = this.lines().find((l) => l.key === this.held.line.key) ?? this.held.line;
    const room = WINDOW + 2 * Math.hypot(x - at[0], y - at[1]);
    const found = nearest(line, x, y, reach(line, row, -1, room), reach(line, row, 1, room));
    this.held.at = [x, y];
    if (!found || found.row === row) return;
    this.held.row = found.row;
    this.moved(line.curve, found.row);
  }

  up() {
    this.held = null;
  }
}

/** Return the row of a line, among first .. last, that is nearest to a place. */
export function nearest(line, x, y, first, last) {
  let row = -1,
    far = Infinity;
  for (let i = first; i <= last; i++) {
    const d = (line.px[i] - x) ** 2 + (line.py[i] - y) ** 2;
    if (d < far) [row, far] = [i, d];
  }
  return row < 0 ? null : { row, far };
}

/** Return the row that is `room` pixels along the line from another one. */
function reach(line, row, way, room) {
  let i = row,
    length = 0;
  while (length < room && i + way >= 0 && i + way < line.px.length) {
    const step = Math.hypot(line.px[i + way] - line.px[i], line.py[i + way] - line.py[i]);
    if (Number.isFinite(step)) length += step;
    i += way;
  }
  return i;
}
