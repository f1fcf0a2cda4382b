// Where labels stand: beside their points, off the curves, and never on each other.

// between a point and its label, and between two labels
const GAP = 8,
  APART = 5;
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
 * Return points with their labels placed: [{...point, text, lx, ly, anchor}].
 *
 * Points at one place share a label. `ink` is a list of [x, y] on the curves, `size` the room [width, height].
 */
export function placeLabels(points, ink, size) {
  const taken = [],
    merged = merge(points);
  for (const p of merged) p.width = 7.2 * p.text.length + 4;
  for (const p of merged) {
    let best = null;
    for (const far of [1, 1.9, 3])
      for (const [k, place] of PLACES.entries()) {
        const box = boxAt(p, place, far);
        const cost =
          100 * overlaps(box, taken, merged, p) +
          60 * outside(box, size) +
          3 * hits(box, ink) +
          0.3 * k +
          6 * (far - 1);
        if (!best || cost < best.cost) best = { cost, box };
      }
    taken.push(best.box);
    Object.assign(p, { lx: best.box.x + best.box.w / 2, ly: best.box.y + best.box.h - 3, box: best.box });
    p.hidden = overlaps(best.box, taken.slice(0, -1), [], p) > 0;
  }
  return merged;
}

function merge(points) {
  const found = [];
  for (const p of points) {
    const same = found.find((q) => Math.hypot(q.px - p.px, q.py - p.py) < 6);
    if (same) same.text = same.text.split(", ").includes(p.label) ? same.text : `${same.text}, ${p.label}`;
    else found.push({ ...p, text: p.label });
  }
  return found;
}

function boxAt(p, [dx, dy], far) {
  const w = p.width,
    height = 14,
    away = GAP * far;
  const x = dx > 0 ? p.px + away : dx < 0 ? p.px - away - w : p.px - w / 2;
  const y = dy > 0 ? p.py + away - 3 : dy < 0 ? p.py - away - height + 3 : p.py - height / 2;
  return { x, y, w, h: height };
}

function overlaps(box, taken, points, own) {
  const boxes = taken.filter(
    (t) => box.x < t.x + t.w + APART && t.x < box.x + box.w + APART && box.y < t.y + t.h && t.y < box.y + box.h,
  );
  const marks = points.filter((p) => p !== own && within(box, p.px, p.py, 6));
  return boxes.length + marks.length;
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
