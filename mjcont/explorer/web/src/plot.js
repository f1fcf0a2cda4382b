// A diagram in SVG: axes, lines by stability, special points with labels; the marker lies over it and repaints nothing.

import { axisBottom, axisLeft } from "d3-axis";
import { select } from "d3-selection";
import { zoom, zoomIdentity } from "d3-zoom";
import { h, s } from "./dom.js";
import { placeLabels } from "./labels.js";
import { extentOf, scaleFor, ticksOf } from "./scales.js";
import { markerPath } from "./symbols.js";
import { nameIntoSvg, plainName, shown, tick } from "./words.js";

const MARGIN = { right: 14, top: 12, bottom: 44 };
// beside the axis: the title, ticks, and what a digit takes
const BESIDE = 34,
  DIGIT = 6.6;
const MOST_INK = 1500;
let clips = 0;

export class Plot {
  /** `zooms` is whether the wheel and two fingers zoom. */
  constructor(host, label, zooms = true) {
    this.host = host;
    this.transform = zoomIdentity;
    this.clip = `mjx-clip-${++clips}`;
    this.svg = s("svg", { class: "plot", role: "img", "aria-label": label });
    this.box = s("rect");
    this.layers = Object.fromEntries(
      ["grid", "x", "y", "lines", "over", "labels", "points"].map((n) => [n, s("g", { class: n })]),
    );
    this.layers.lines.setAttribute("clip-path", `url(#${this.clip})`);
    this.layers.over.setAttribute("clip-path", `url(#${this.clip})`);
    this.titles = [s("text", { class: "axis-title" }), s("text", { class: "axis-title" })];
    this.svg.append(
      s("defs", {}, s("clipPath", { id: this.clip }, this.box)),
      ...Object.values(this.layers),
      ...this.titles,
    );
    this.dot = h("div", { class: "marker", "aria-hidden": "true" });
    this.words = h("div", { class: "hint", "aria-hidden": "true", hidden: true });
    host.append(this.svg, this.dot, this.words);
    this.content = null;
    if (zooms) this.enableZoom();
    new ResizeObserver(() => this.content && this.render()).observe(host);
  }

  enableZoom() {
    this.zoom = zoom()
      .scaleExtent([1, 4000])
      .filter((e) => e.type === "wheel" || e.touches?.length > 1 || (e.type === "mousedown" && e.shiftKey))
      .on("zoom", ({ transform }) => {
        this.transform = transform;
        if (this.content) this.render();
      });
    select(this.svg).call(this.zoom).on("dblclick.zoom", null);
    this.svg.addEventListener("dblclick", () => this.resetZoom());
  }

  resetZoom() {
    if (this.zoom) select(this.svg).call(this.zoom.transform, zoomIdentity);
  }

  /**
   * Draw content: {x, y: {quantity, name, kind, suffix, extent}, lines: [{xs, ys, runs, cls, key}], points, over}.
   *
   * xs and ys are typed arrays as shown; `points` have x, y, label, kind; `over(plot)` draws more above the lines.
   */
  draw(content) {
    this.content = content;
    this.render();
  }

  render() {
    const { width, height } = this.host.getBoundingClientRect();
    if (width < 40 || height < 40) return;
    const { x, y, lines } = this.content,
      ends = (axis, values) => axis.extent ?? extentOf(values);
    const [y0, y1] = [MARGIN.top, height - MARGIN.bottom];
    this.y = this.zoomed(
      "rescaleY",
      scaleFor(
        ends(
          y,
          lines.map((l) => l.ys),
        ),
        [y1, y0],
        y.kind,
        y.typical,
      ),
    );
    const yTicks = ticksOf(this.y, Math.max(2, Math.floor((y1 - y0) / 44)));
    const [x0, x1] = [BESIDE + DIGIT * Math.max(...yTicks.map((v) => tick(v).length), 2), width - MARGIN.right];
    this.inner = [x0, y0, x1, y1];
    this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    for (const [key, value] of Object.entries({ x: x0, y: y0, width: x1 - x0, height: y1 - y0 }))
      this.box.setAttribute(key, value);
    this.zoom
      ?.extent([
        [x0, y0],
        [x1, y1],
      ])
      .translateExtent([
        [x0, y0],
        [x1, y1],
      ]);
    this.x = this.zoomed(
      "rescaleX",
      scaleFor(
        ends(
          x,
          lines.map((l) => l.xs),
        ),
        [x0, x1],
        x.kind,
        x.typical,
      ),
    );
    if (this.content.equal) this.equalise();
    this.drawAxes(yTicks);
    this.drawLines();
    this.drawPoints();
    this.layers.over.textContent = "";
    this.content.over?.(this, this.layers.over);
    this.place(this.at);
    this.content.drawn?.(this);
  }

  /** Give both axes one scale: a circle is round. */
  equalise() {
    const [x0, y0, x1, y1] = this.inner,
      per = (scale, pixels) => (scale.domain()[1] - scale.domain()[0]) / pixels;
    const size = Math.max(per(this.x, x1 - x0), per(this.y, y1 - y0));
    for (const [scale, pixels] of [
      [this.x, x1 - x0],
      [this.y, y1 - y0],
    ]) {
      const [low, high] = scale.domain(),
        middle = (low + high) / 2;
      scale.domain([middle - (size * pixels) / 2, middle + (size * pixels) / 2]);
    }
  }

  zoomed(how, scale) {
    if (this.transform === zoomIdentity || this.transform.k === 1) return scale;
    const ticks = Object.hasOwn(scale, "ticks") ? scale.ticks : null,
      other = this.transform[how](scale);
    if (ticks && scale.constant) other.ticks = (count) => ticks(count).filter((v) => between(v, other.domain()));
    return other;
  }

  drawAxes(yTicks) {
    const [x0, y0, x1, y1] = this.inner,
      xTicks = ticksOf(this.x, Math.max(2, Math.floor((x1 - x0) / 80)));
    const bottom = axisBottom(this.x).tickValues(xTicks).tickFormat(tick).tickSize(4).tickPadding(5);
    const left = axisLeft(this.y).tickValues(yTicks).tickFormat(tick).tickSize(4).tickPadding(5);
    select(this.layers.x).attr("transform", `translate(0,${y1})`).call(bottom);
    select(this.layers.y).attr("transform", `translate(${x0},0)`).call(left);
    spreadTicks(this.layers.x, (box) => [box.left, box.right], 6);
    spreadTicks(this.layers.y, (box) => [-box.bottom, -box.top], 0);
    for (const axis of [this.layers.x, this.layers.y])
      for (const name of ["fill", "font-size", "font-family"]) axis.removeAttribute(name);
    const grid = [
      ...xTicks.map((v) => line(this.x(v), y0, this.x(v), y1, v === 0)),
      ...yTicks.map((v) => line(x0, this.y(v), x1, this.y(v), v === 0)),
    ];
    this.layers.grid.replaceChildren(...grid);
    const { x, y } = this.content,
      [below, beside] = this.titles;
    nameIntoSvg(below, x.quantity, x.name, x.suffix);
    nameIntoSvg(beside, y.quantity, y.name, y.suffix);
    below.setAttribute("x", (x0 + x1) / 2);
    below.setAttribute("y", y1 + 36);
    beside.setAttribute("transform", `translate(15,${(y0 + y1) / 2}) rotate(-90)`);
  }

  drawLines() {
    const paths = [];
    this.ink = [];
    for (const l of this.content.lines) {
      const px = pixels(l.xs, this.x),
        py = pixels(l.ys, this.y);
      l.px = px;
      l.py = py;
      for (const run of l.runs)
        paths.push(
          s("path", { class: `line ${l.cls ?? ""} ${run.cls ?? ""}`, d: pathOf(px, py, run.first, run.last, l.turn) }),
        );
      const every = Math.max(1, Math.floor(px.length / (MOST_INK / this.content.lines.length)));
      for (let i = 0; i < px.length; i += every) if (inside(px[i], py[i], this.inner)) this.ink.push([px[i], py[i]]);
    }
    this.layers.lines.replaceChildren(...paths);
  }

  drawPoints() {
    const { points = [] } = this.content;
    const seen = points
      .map((p) => ({ ...p, px: this.x(p.x), py: this.y(p.y) }))
      .filter((p) => inside(p.px, p.py, this.inner, 1));
    const marks = seen.map((p) =>
      s("path", {
        class: `point ${p.cls ?? ""}`,
        d: markerPath(p.kind),
        transform: `translate(${p.px.toFixed(1)},${p.py.toFixed(1)})`,
      }),
    );
    const [x0, y0, x1, y1] = this.inner;
    const shifted = seen.filter((p) => p.label).map((p) => ({ ...p, px: p.px - x0, py: p.py - y0 }));
    const placed = placeLabels(
      shifted,
      this.ink.map(([a, b]) => [a - x0, b - y0]),
      [x1 - x0, y1 - y0],
      seen.map((p) => [p.px - x0, p.py - y0]),
    ).filter((p) => !p.hidden);
    this.layers.labels.replaceChildren(
      ...placed.filter((p) => p.led).map(({ led: [a, b, c, d] }) => line(a + x0, b + y0, c + x0, d + y0)),
      ...placed.map((p) => {
        const text = s("text", { x: p.lx + x0, y: p.ly + y0, "text-anchor": "middle" });
        text.textContent = p.text;
        return text;
      }),
    );
    this.layers.points.replaceChildren(...marks);
  }

  /** Put the marker at a place as shown, [x, y]; hide it for null. */
  place(at) {
    this.at = at;
    const px = at && this.x ? this.x(at[0]) : NaN,
      py = at && this.y ? this.y(at[1]) : NaN;
    const there = this.inner && inside(px, py, this.inner, 8);
    this.dot.style.opacity = there ? "1" : "0";
    if (there) this.dot.style.transform = `translate(${px.toFixed(2)}px,${py.toFixed(2)}px)`;
  }

  /** Say in words what a row of a line is, beside it; nothing for null. */
  hint(found) {
    this.words.hidden = !found;
    if (!found) return;
    const { line, row } = found,
      { x, y } = this.content,
      { width } = this.host.getBoundingClientRect();
    const special = line.curve.special?.get(row),
      told = special ? [special.label] : [];
    told.push(`${plainName(x.quantity, x.name)} = ${value(line.xs[row], x.quantity)}`);
    told.push(`${plainName(y.quantity, y.name)} = ${value(line.ys[row], y.quantity)}`);
    this.words.textContent = told.join("\n");
    const left = line.px[row] > width / 2,
      top = Math.max(4, line.py[row] - 14);
    this.words.style.left = left ? "auto" : `${line.px[row] + 14}px`;
    this.words.style.right = left ? `${width - line.px[row] + 14}px` : "auto";
    this.words.style.top = `${top}px`;
  }

  /** Return where an event is, in pixels of the diagram. */
  where(event) {
    const box = this.svg.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }
}

function value(number, quantity) {
  return shown(number, { ...quantity, scale: 1 }, 4);
}

function between(v, [a, b]) {
  return v >= Math.min(a, b) && v <= Math.max(a, b);
}

function pixels(values, scale) {
  const found = new Float32Array(values.length);
  for (let i = 0; i < values.length; i++) found[i] = scale(values[i]);
  return found;
}

/** Return the path of rows first .. last; points closer than a third of a pixel are one. */
function pathOf(px, py, first, last, turn) {
  const parts = [];
  let lx = NaN,
    ly = NaN,
    pen = "M";
  for (let i = first; i <= last; i++) {
    const x = px[i],
      y = py[i];
    if (!(Number.isFinite(x) && Number.isFinite(y))) {
      pen = "M";
      continue;
    }
    if (turn?.(i)) pen = "M";
    if (pen === "L" && i !== last && Math.abs(x - lx) < 0.35 && Math.abs(y - ly) < 0.35) continue;
    parts.push(`${pen}${x.toFixed(2)},${y.toFixed(2)}`);
    [lx, ly, pen] = [x, y, "L"];
  }
  return parts.join("");
}

function inside(x, y, [x0, y0, x1, y1], room = 0) {
  return x >= x0 - room && x <= x1 + room && y >= y0 - room && y <= y1 + room;
}

function line(x1, y1, x2, y2, zero) {
  return s("line", {
    x1: x1.toFixed(1),
    y1: y1.toFixed(1),
    x2: x2.toFixed(1),
    y2: y2.toFixed(1),
    class: zero ? "zero" : "",
  });
}

/** Hide numbers beside an axis that would touch another one; the zero stays. */
function spreadTicks(layer, sides, gap) {
  const texts = [...layer.querySelectorAll(".tick text")],
    taken = [];
  const boxes = new Map(texts.map((text) => [text, sides(text.getBoundingClientRect())]));
  for (const text of texts.toSorted((a, b) => Number(b.textContent === "0") - Number(a.textContent === "0"))) {
    const [low, high] = boxes.get(text),
      free = taken.every(([a, b]) => high + gap < a || b + gap < low);
    text.style.visibility = free ? "" : "hidden";
    if (free) taken.push([low, high]);
  }
}
