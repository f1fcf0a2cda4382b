// Where labels stand: nearer to their own points than to any other, off the curves, and never on each other.

// between a point and its label, and between two labels; beyond the third, a line leads to the point
const GAP = 8,
  APART = 5,
  LED = 13;
// how much nearer a label without a line is to its own point than to another one
const CLEARLY = 5;
const FAR = [1, 1.9, 3, 4.5, 6.5];
const PLACES = [
  [1, -1],
  [1, 1],
  [-1, -1],
  [-1, 1],
  [0, -1],
  [0, 1],
  [1, 0],
  [-1, 0],
];

/**
 * Return points with their labels placed: [{...point, text, lx, ly, led}].
 *
 * Points at one place share a label. `ink` is a list of [x, y] on the curves, `size` the room [width, height], `marks`
 * a list of [x, y] of all points, labelled or not. `led` is the line [x, y, x, y] from a point to a label that stands
 * apart, else null.
 */
export function placeLabels(points, ink, size, marks) {
  const taken = [],
    merged = merge(points);
  for (const p of merged) p.width = 7.2 * p.text.length + 4;
  for (const p of merged) {
    const others = marks.filter(([x, y]) => Math.hypot(x - p.px, y - p.py) >= 6);
    let best = null;
    for (const far of FAR)
      for (const [k, place] of PLACES.entries()) {
        const box = boxAt(p, place, far),
          led = leader(p, box);
        const cost =
          100 * (overlaps(box, taken, others) + mistaken(p, box, led, others, taken)) +
          60 * outside(box, size) +
          3 * hits(box, ink) +
          0.3 * k +
          6 * (far - 1);
        if (!best || cost < best.cost) best = { cost, box, led };
      }
    p.hidden = overlaps(best.box, taken, []) + mistaken(p, best.box, best.led, others, taken) > 0;
    if (!p.hidden) taken.push({ ...best.box, led: best.led });
    Object.assign(p, { lx: best.box.x + best.box.w / 2, ly: best.box.y + best.box.h - 3, led: best.led });
  }
  return merged;
}

function merge(points) {
  const found = [];
  for (const p of points) {
    const same = found.find((q) => Math.hypot(q.px - p.px, q.py - p.py) < 6);
    if (same) same.texts.add(p.label);
    else found.push({ ...p, texts: new Set([p.label]) });
  }
  const ordered = (texts) => [...texts].sort((a, b) => a.localeCompare(b, "en", { numeric: true }));
  return found.map(({ texts, ...p }) => ({ ...p, text: ordered(texts).join(", ") }));
}

function boxAt(p, [dx, dy], far) {
  const w = p.width,
    height = 14,
    away = GAP * far;
  const x = dx > 0 ? p.px + away : dx < 0 ? p.px - away - w : p.px - w / 2;
  const y = dy > 0 ? p.py + away - 3 : dy < 0 ? p.py - away - height + 3 : p.py - height / 2;
  return { x, y, w, h: height };
}

/** Return the place of a box nearest to a point, and how far that is. */
function nearest(box, x, y) {
  const bx = Math.max(box.x, Math.min(x, box.x + box.w)),
    by = Math.max(box.y, Math.min(y, box.y + box.h));
  return [bx, by, Math.hypot(bx - x, by - y)];
}

/** Return the line from a point to a label that stands apart from it, null for one beside it. */
function leader(p, box) {
  const [x, y, d] = nearest(box, p.px, p.py);
  return d > LED ? [p.px, p.py, x, y] : null;
}

/** Return 1 where a label could be read as another point's: nearer to that, or its line passes that or a label. */
function mistaken(p, box, led, others, taken) {
  const [, , own] = nearest(box, p.px, p.py);
  if (!led) return Number(others.some(([x, y]) => nearest(box, x, y)[2] < own + CLEARLY));
  const [x0, y0, x1, y1] = led;
  for (let t = 0; t <= 1; t += 0.1) {
    const [x, y] = [x0 + t * (x1 - x0), y0 + t * (y1 - y0)];
    if (others.some(([a, b]) => Math.hypot(a - x, b - y) < 7) || taken.some((b) => within(b, x, y, 1))) return 1;
  }
  return 0;
}

function overlaps(box, taken, marks) {
  const boxes = taken.filter(
    (t) =>
      (box.x < t.x + t.w + APART && t.x < box.x + box.w + APART && box.y < t.y + t.h && t.y < box.y + box.h) ||
      crossed(box, t.led),
  );
  return boxes.length + marks.filter(([x, y]) => within(box, x, y, 6)).length;
}

/** Whether a line leads through a box. */
function crossed(box, led) {
  if (!led) return false;
  const [x0, y0, x1, y1] = led;
  return Array.from({ length: 11 }, (_, k) => k / 10).some((t) =>
    within(box, x0 + t * (x1 - x0), y0 + t * (y1 - y0), 1),
  );
}

function within(box, x, y, room) {
  return x > box.x - room && x < box.x + box.w + room && y > box.y - room && y < box.y + box.h + room;
}

function outside(box, [width, height]) {
  return Number(box.x < 0 || box.y < 0 || box.x + box.w > width || box.y + box.h > height);
}

function hits(box, ink) {
  let count = 0;
  for (const [x, y] of ink) if (within(box, x, y, 1)) count++;
  return Math.min(count, 12);
}
