// The document as the browser uses it: arrays decoded once, curves with what drawing and dragging need.

const TYPES = {
  f4: Float32Array,
  f8: Float64Array,
  i1: Int8Array,
  i4: Int32Array,
  u2: Uint16Array,
  u4: Uint32Array,
};
export const STABLE = 1,
  MARGINAL = 0,
  UNSTABLE = -1,
  JUMPING = 2;
export const STABILITY = { [STABLE]: "stable", [MARGINAL]: "marginal", [UNSTABLE]: "unstable", [JUMPING]: "jumping" };

/** Return a packed array as a typed one that knows its `shape`; null stays null. */
export function unpack(packed) {
  if (!packed) return null;
  const text = atob(packed.data);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  const array = new TYPES[packed.dtype](bytes.buffer);
  array.shape = packed.shape;
  return array;
}

/** Return a mapping of names that has nothing but them: a model may call something "constructor". */
export function byName(object) {
  return Object.assign(Object.create(null), object);
}

function unpackEach(columns) {
  const found = byName(columns);
  for (const name of Object.keys(found)) found[name] = unpack(found[name]);
  return found;
}

/** Return a curve with its arrays decoded; `rows` is their length. */
export function curveOf(raw) {
  const columns = unpackEach(raw.columns);
  const first = Object.values(columns)[0];
  const curve = { ...raw, columns, free: byName(raw.free), fixed: byName(raw.fixed), rows: first ? first.length : 0 };
  for (const key of ["poses", "shapes", "tendons", "eigenvalues", "stability", "unstable", "pieces", "own"])
    curve[key] = unpack(raw[key]);
  if (raw.orbit) {
    const { poses, shapes, tendons, rows, period } = raw.orbit;
    curve.orbit = {
      ...raw.orbit,
      columns: unpackEach(raw.orbit.columns),
      rows: unpack(rows),
      period: unpack(period),
      poses: unpack(poses),
      shapes: unpack(shapes),
      tendons: unpack(tendons),
    };
  }
  if (raw.kind === "sensitivities") {
    curve.derivatives = unpack(raw.derivatives);
    curve.changes = unpack(raw.changes);
  }
  if (raw.kind === "map") curve.grid = unpackEach(raw.grid);
  curve.special = new Map(raw.specials.map((s) => [s.row, s]));
  return curve;
}

/** Return a column of a curve, also of a parameter that is held along it; null if it has none. */
export function columnOf(curve, name) {
  if (curve.columns[name]) return curve.columns[name];
  const held = curve.fixed?.[name];
  return held === undefined || held === null ? null : new Float64Array(curve.rows).fill(held);
}

/** Return the columns that a diagram shows for a name: of orbits the largest and the smallest value. */
export function drawnColumns(curve, name) {
  const own = columnOf(curve, name);
  if (own) return [own];
  const ends = [curve.columns[`${name}.max`], curve.columns[`${name}.min`]];
  return ends[0] ? ends : [];
}

/** Return the stored orbit nearest to a row: its place among `orbit.rows`. */
export function orbitAt(curve, row) {
  const rows = curve.orbit.rows;
  let best = 0;
  for (let k = 1; k < rows.length; k++) if (Math.abs(rows[k] - row) < Math.abs(rows[best] - row)) best = k;
  return best;
}

/** Return one sample of an orbit's motion as a pose: bodies, shapes and springs, each a view on a row. */
export function poseOfOrbit(curve, row, sample) {
  const k = orbitAt(curve, row),
    { poses, tendons, shapes } = curve.orbit;
  if (!poses) return null;
  const at = (array, first) => {
    if (!array) return null;
    const [, samples, ...rest] = array.shape,
      size = rest.reduce((a, b) => a * b, 1);
    const one = (samples === 1 ? 0 : first) + k * samples;
    return array.subarray(one * size, (one + 1) * size);
  };
  return { bodies: at(poses, sample), tendons: at(tendons, sample), shapes: at(shapes, sample) };
}

/** Return the pose of a row: bodies, shapes and springs, each a view on a row; null where there is none. */
export function poseOf(curve, row) {
  if (!curve?.poses) return null;
  const at = (array) => {
    if (!array) return null;
    const size = array.length / array.shape[0],
      k = array.shape[0] === 1 ? 0 : row;
    return array.subarray(k * size, (k + 1) * size);
  };
  return { bodies: at(curve.poses), tendons: at(curve.tendons), shapes: at(curve.shapes) };
}

/** Return the eigenvalues of a row as [re, im] pairs; none where they are not known. */
export function eigenvaluesOf(curve, row) {
  const table = curve.eigenvalues,
    found = [];
  if (!table) return found;
  const width = table.shape[1];
  for (let k = 0; k < width; k++) {
    const re = table[2 * (row * width + k)],
      im = table[2 * (row * width + k) + 1];
    if (Number.isFinite(re) && Number.isFinite(im)) found.push([re, im]);
  }
  return found;
}

/** Return runs [first, last] of rows of one stability; neighbours share a row, so that lines meet. */
export function runsOf(curve) {
  const codes = curve.stability,
    runs = [];
  if (!codes) return [{ first: 0, last: curve.rows - 1, code: null }];
  const code = (i) => (codes[i] === MARGINAL ? null : codes[i]);
  let first = 0,
    now = null;
  for (let i = 0; i < curve.rows; i++) {
    const here = code(i);
    if (here === null || here === now) continue;
    if (now !== null) {
      runs.push({ first, last: i, code: now });
      // the change lies at a marginal row, where there is one
      const turn = i > 0 && code(i - 1) === null ? i - 1 : now === JUMPING ? i : i - 1;
      runs.at(-1).last = turn;
      first = turn;
    }
    now = here;
  }
  runs.push({ first, last: curve.rows - 1, code: now ?? MARGINAL });
  return runs;
}
