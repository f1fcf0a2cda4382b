// The mechanism as a drawing in SVG: for browsers without WebGL, and as the picture to take along.

import { Matrix4, Quaternion, Vector3 } from "three";
import { s } from "./dom.js";

const MOST_CORNERS = 40;
const GOLDEN = Math.PI * (3 - Math.sqrt(5));

/** Return unit vectors [right, up, toward] of the view of a scene. */
export function viewOf(scene) {
  const toward = new Vector3(...scene.toward).normalize();
  const right = new Vector3(...scene.up).cross(toward).normalize();
  return [right, toward.clone().cross(right), toward];
}

export class Stick {
  constructor(host, scene, label) {
    this.scene = scene;
    this.svg = s("svg", { class: "stick", role: "img", "aria-label": label });
    host?.append(this.svg);
    this.axes = viewOf(scene);
    this.corners = scene.geoms.map((g) => cornersOf(g, scene.meshes));
    this.box = null;
  }

  /** Look along other axes: [right, up, toward]. */
  look(axes) {
    this.axes = axes;
  }

  /** Draw the poses of rows into one box, so that nothing jumps: `spheres` is a list of [x, y, z, radius]. */
  frame(spheres) {
    const [right, up] = this.axes;
    const box = [Infinity, Infinity, -Infinity, -Infinity];
    for (const [x, y, z, r] of spheres) {
      const p = new Vector3(x, y, z),
        u = p.dot(right),
        v = -p.dot(up);
      ((box[0] = Math.min(box[0], u - r)), (box[1] = Math.min(box[1], v - r)));
      ((box[2] = Math.max(box[2], u + r)), (box[3] = Math.max(box[3], v + r)));
    }
    if (!spheres.length) box.splice(0, 4, -1, -1, 1, 1);
    const width = Math.max(box[2] - box[0], 1e-6),
      height = Math.max(box[3] - box[1], 1e-6),
      room = 0.06 * Math.max(width, height);
    this.svg.setAttribute("viewBox", `${box[0] - room} ${box[1] - room} ${width + 2 * room} ${height + 2 * room}`);
    this.size = Math.max(width, height);
  }

  pose(pose) {
    const parts = [],
      [, , toward] = this.axes;
    const frames = framesOf(pose.bodies, this.scene.bodies.length);
    for (const [k, geom] of this.scene.geoms.entries()) {
      const place = placeOf(geom, frames, pose.shapes, k);
      const drawn = this.drawn(geom, place, this.corners[k], pose.shapes, k);
      if (drawn) parts.push([drawn, new Vector3().setFromMatrixPosition(place).dot(toward)]);
    }
    parts.sort((a, b) => a[1] - b[1]);
    let at = 0;
    const tendons = [];
    for (const t of this.scene.tendons) {
      const path = [];
      for (let i = 0; i < t.points; i++)
        path.push(this.flat(new Vector3(...pose.tendons.subarray(3 * (at + i), 3 * (at + i) + 3))));
      at += t.points;
      tendons.push(
        s("path", {
          class: "tendon",
          d: pathOf(path),
          fill: "none",
          stroke: colour(t.rgba),
          "stroke-width": 2 * t.width,
          "stroke-linecap": "round",
        }),
      );
    }
    this.svg.replaceChildren(...parts.map((p) => p[0]), ...tendons);
  }

  flat(p) {
    const [right, up] = this.axes;
    return [p.dot(right), -p.dot(up)];
  }

  drawn(geom, place, corners, shapes, k) {
    const fill = colour(geom.rgba),
      size = sizeOf(geom, shapes, k);
    if (geom.type === "sphere" || geom.type === "ellipsoid") {
      const [cx, cy] = this.flat(new Vector3().setFromMatrixPosition(place));
      return s("circle", { cx, cy, r: geom.type === "sphere" ? size[0] : Math.max(...size), fill });
    }
    if (geom.type === "capsule" || geom.type === "cylinder") {
      const a = this.flat(new Vector3(0, 0, size[1]).applyMatrix4(place)),
        b = this.flat(new Vector3(0, 0, -size[1]).applyMatrix4(place));
      if (Math.hypot(a[0] - b[0], a[1] - b[1]) < 0.3 * size[0])
        return s("circle", { cx: a[0], cy: a[1], r: size[0], fill });
      const cap = geom.type === "capsule" ? "round" : "butt";
      return s("line", {
        x1: a[0],
        y1: a[1],
        x2: b[0],
        y2: b[1],
        stroke: fill,
        "stroke-width": 2 * size[0],
        "stroke-linecap": cap,
      });
    }
    if (!corners?.length) return null;
    const hull = hullOf(corners.map((c) => this.flat(c.clone().applyMatrix4(place))));
    return s("path", { d: `${pathOf(hull)}Z`, fill });
  }
}

/** Return the frame of each body from a pose, the world's last. */
export function framesOf(bodies, count) {
  const frames = [];
  for (let b = 0; b < count; b++) {
    const [x, y, z, w, i, j, k] = bodies.subarray(7 * b, 7 * b + 7);
    frames.push(new Matrix4().compose(new Vector3(x, y, z), new Quaternion(i, j, k, w), new Vector3(1, 1, 1)));
  }
  return frames;
}

function placeOf(geom, frames, shapes, k) {
  const row = shapes && k * 10 + 10 <= shapes.length ? shapes.subarray(10 * k, 10 * k + 7) : null;
  const pos = row ? row.subarray(0, 3) : geom.pos,
    [w, x, y, z] = row ? row.subarray(3, 7) : geom.quat;
  const local = new Matrix4().compose(new Vector3(...pos), new Quaternion(x, y, z, w), new Vector3(1, 1, 1));
  return geom.body < 0 ? local : frames[geom.body].clone().multiply(local);
}

function sizeOf(geom, shapes, k) {
  return shapes && k * 10 + 10 <= shapes.length && geom.type !== "plane"
    ? shapes.subarray(10 * k + 7, 10 * k + 10)
    : geom.size;
}

/** Return points whose hull is what a shape covers: of a mesh the outermost ones in many directions. */
function cornersOf(geom, meshes) {
  if (geom.type === "box") {
    const [a, b, c] = geom.size;
    return [-1, 1].flatMap((x) => [-1, 1].flatMap((y) => [-1, 1].map((z) => new Vector3(a * x, b * y, c * z))));
  }
  if (geom.type === "plane")
    return [
      [-1, -1],
      [-1, 1],
      [1, 1],
      [1, -1],
    ].map(([x, y]) => new Vector3(x * geom.size[0], y * geom.size[1], 0));
  if (geom.type !== "mesh") return null;
  return outermost(meshes[geom.mesh].vertices).map((p) => new Vector3(...p));
}

/** Return the outermost of vertices in many directions, spread evenly, as [x, y, z]. */
export function outermost(v) {
  const found = new Set();
  for (let n = 0; n < MOST_CORNERS; n++) {
    const z = 1 - (2 * n + 1) / MOST_CORNERS,
      r = Math.sqrt(1 - z * z),
      a = GOLDEN * n;
    let best = 0,
      far = -Infinity;
    for (let i = 0; i < v.length; i += 3) {
      const d = v[i] * r * Math.cos(a) + v[i + 1] * r * Math.sin(a) + v[i + 2] * z;
      if (d > far) [best, far] = [i, d];
    }
    found.add(best);
  }
  return [...found].map((i) => [v[i], v[i + 1], v[i + 2]]);
}

function colour([r, g, b, a]) {
  const c = (v) => Math.round(255 * v);
  return a < 1 ? `rgba(${c(r)},${c(g)},${c(b)},${a})` : `rgb(${c(r)},${c(g)},${c(b)})`;
}

function pathOf(points) {
  return points.map(([x, y], i) => `${i ? "L" : "M"}${x.toFixed(5)},${y.toFixed(5)}`).join("");
}

/** Return the convex hull of points [x, y], Andrew's monotone chain. */
function hullOf(points) {
  const sorted = points.toSorted((a, b) => a[0] - b[0] || a[1] - b[1]);
  const half = (list) => {
    const found = [];
    for (const p of list) {
      while (found.length > 1 && cross(found.at(-2), found.at(-1), p) <= 0) found.pop();
      found.push(p);
    }
    return found.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.toReversed())];
}

function cross(o, a, b) {
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}
