// The mechanism in three dimensions, drawn when something changes; without WebGL the drawing of `stick`.

import {
  AmbientLight,
  DirectionalLight,
  Group,
  HemisphereLight,
  PerspectiveCamera,
  Scene,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { unpack } from "./data.js";
import { geometriesOf, objectOf, resize, Tendons } from "./shapes.js";
import { outermost, Stick, viewOf } from "./stick.js";

const FIELD = 26;
// a little from the side, so that depth is seen
const SIDE = 0.22,
  ABOVE = 0.13;

/** Return the scene of a document with its meshes decoded. */
export function sceneOf(scene) {
  const meshes = scene.meshes.map((m) => ({ vertices: unpack(m.vertices), faces: unpack(m.faces) }));
  const pose = { bodies: unpack(scene.pose.bodies), tendons: unpack(scene.pose.tendons), shapes: null };
  return { ...scene, meshes, pose };
}

/** Return spheres [x, y, z, radius] round the shapes and tendons of poses: what a view must hold. */
export function spheresOf(scene, poses) {
  const found = [],
    p = new Vector3(),
    own = scene.geoms.map((g) => spheresOn(g, scene.meshes));
  for (const [k, g] of scene.geoms.entries()) if (g.body < 0) found.push(...own[k]);
  const widths = scene.tendons.flatMap((t) => Array(t.points).fill(t.width));
  for (const { bodies, tendons } of poses) {
    for (const [k, r] of widths.entries()) if (tendons) found.push([...tendons.subarray(3 * k, 3 * k + 3), r]);
    for (const [k, g] of scene.geoms.entries()) {
      if (g.body < 0) continue;
      const [x, y, z, w, i, j, l] = bodies.subarray(7 * g.body, 7 * g.body + 7);
      for (const [a, b, c, r] of own[k]) {
        p.set(a, b, c).applyQuaternion({ x: i, y: j, z: l, w });
        found.push([p.x + x, p.y + y, p.z + z, r]);
      }
    }
  }
  return found;
}

/** Return spheres round a shape in the frame of its body; none round an endless plane. */
function spheresOn(g, meshes) {
  const p = new Vector3(),
    [w, x, y, z] = g.quat,
    [a, b, c] = g.size;
  const at = (u, v, t, r) => {
    p.set(u, v, t).applyQuaternion({ x, y, z, w });
    return [p.x + g.pos[0], p.y + g.pos[1], p.z + g.pos[2], r];
  };
  if (g.type === "plane") return [];
  if (g.type === "sphere") return [at(0, 0, 0, a)];
  if (g.type === "ellipsoid") return [at(0, 0, 0, Math.max(a, b, c))];
  if (g.type === "capsule" || g.type === "cylinder") return [at(0, 0, b, a), at(0, 0, -b, a)];
  const corners =
    g.type === "box"
      ? [-a, a].flatMap((u) => [-b, b].flatMap((v) => [-c, c].map((t) => [u, v, t])))
      : outermost(meshes[g.mesh].vertices);
  return corners.map(([u, v, t]) => at(u, v, t, 0));
}

export class Mechanism {
  constructor(host, scene, label) {
    this.host = host;
    this.scene = scene;
    this.label = label;
    this.renderer = null;
    const canvas = document.createElement("canvas"),
      context = canvas.getContext("webgl2", { antialias: true, alpha: true });
    if (context) this.begin(canvas, context);
    else this.stick = new Stick(host, scene, label);
    host.dataset.drawn = this.renderer ? "webgl" : "svg";
  }

  begin(canvas, context) {
    this.renderer = new WebGLRenderer({ canvas, context });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", this.label);
    this.host.append(canvas);
    this.world = new Scene();
    this.camera = new PerspectiveCamera(FIELD, 1, 0.01, 100);
    this.camera.up.fromArray(this.scene.up);
    const key = new DirectionalLight(0xffffff, 1.9);
    key.position.set(0.5, 0.9, 1);
    this.camera.add(key);
    this.world.add(this.camera, new HemisphereLight(0xffffff, 0x8a94a6, 1.55), new AmbientLight(0xffffff, 0.35));
    this.bodies = this.scene.bodies.map(() => new Group());
    this.ground = new Group();
    this.world.add(this.ground, ...this.bodies);
    const geometries = geometriesOf(this.scene.meshes);
    this.shapes = this.scene.geoms.map((g) => {
      const object = objectOf(g, geometries);
      (g.body < 0 ? this.ground : this.bodies[g.body]).add(object);
      return object;
    });
    this.tendons = new Tendons(this.scene.tendons, this.world);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.addEventListener("change", () => this.ask());
    this.controls.addEventListener("start", () => (this.untouched = false));
    canvas.addEventListener("dblclick", () => this.frame());
    new ResizeObserver(() => this.fit()).observe(this.host);
  }

  /** Move to a pose; it is drawn with the next frame. */
  pose(pose) {
    if (!pose) return;
    this.last = pose;
    if (!this.renderer) {
      this.stick.pose(pose);
      return;
    }
    const { bodies, shapes, tendons } = pose;
    for (const [b, group] of this.bodies.entries()) {
      const at = 7 * b;
      group.position.set(bodies[at], bodies[at + 1], bodies[at + 2]);
      group.quaternion.set(bodies[at + 4], bodies[at + 5], bodies[at + 6], bodies[at + 3]);
    }
    if (shapes) this.reshape(shapes);
    else if (this.reshaped) this.reshape(this.own());
    this.reshaped = Boolean(shapes);
    if (tendons) this.tendons.pose(tendons);
    this.ask();
  }

  own() {
    return new Float32Array(this.scene.geoms.flatMap((g) => [...g.pos, ...g.quat, ...g.size]));
  }

  reshape(shapes) {
    for (const [k, geom] of this.scene.geoms.entries()) {
      if (10 * k + 10 > shapes.length) break;
      const row = shapes.subarray(10 * k, 10 * k + 10),
        mesh = this.shapes[k];
      mesh.position.set(row[0], row[1], row[2]);
      mesh.quaternion.set(row[4], row[5], row[6], row[3]);
      if (geom.type !== "mesh" && geom.type !== "plane") resize(mesh, geom, row.subarray(7, 10));
    }
  }

  /** Look so that all of some poses is seen. */
  frame(poses = this.framed ?? []) {
    this.framed = poses;
    this.untouched = true;
    const spheres = spheresOf(this.scene, poses);
    if (!this.renderer) {
      this.stick.frame(spheres);
      return;
    }
    this.spheres = spheres;
    const [right, up, toward] = viewOf(this.scene);
    this.direction = toward.clone();
    if (this.scene.planar) this.direction.addScaledVector(right, SIDE).addScaledVector(up, ABOVE);
    this.direction.normalize();
    this.fit();
  }

  /** Take the size of the panel, and stand as near as lets everything be seen. */
  fit() {
    const { width, height } = this.host.getBoundingClientRect();
    if (width < 2 || height < 2) return;
    this.renderer.setSize(width, height, true);
    this.camera.aspect = width / height;
    if (this.spheres) this.stand();
    this.camera.updateProjectionMatrix();
    this.ask();
  }

  stand() {
    const { camera, direction, spheres } = this,
      up = new Vector3().fromArray(this.scene.up);
    const right = up.clone().cross(direction).normalize(),
      over = direction.clone().cross(right);
    const low = [Infinity, Infinity, Infinity],
      high = [-Infinity, -Infinity, -Infinity],
      axes = [right, over, direction];
    const p = new Vector3();
    for (const [x, y, z, r] of spheres)
      for (const [k, axis] of axes.entries()) {
        const d = p.set(x, y, z).dot(axis);
        low[k] = Math.min(low[k], d - r);
        high[k] = Math.max(high[k], d + r);
      }
    if (!(high[0] >= low[0])) return;
    const half = [0, 1].map((k) => Math.max(0.55 * (high[k] - low[k]), 1e-3)),
      slope = Math.tan((FIELD * Math.PI) / 360);
    const far = Math.max(half[1] / slope, half[0] / (slope * camera.aspect)) + 0.5 * (high[2] - low[2]);
    const centre = new Vector3();
    for (const [k, axis] of axes.entries()) centre.addScaledVector(axis, 0.5 * (low[k] + high[k]));
    camera.position.copy(centre).addScaledVector(direction, far);
    camera.near = far / 200;
    camera.far = 20 * far;
    this.controls.target.copy(centre);
    this.controls.update();
  }

  ask() {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      this.renderer.render(this.world, this.camera);
      this.host.dataset.frames = String(Number(this.host.dataset.frames ?? 0) + 1);
    });
  }

  /** Return the drawing of what is seen now as an SVG element. */
  picture() {
    const stick = this.stick ?? new Stick(null, this.scene, this.label);
    if (this.renderer) {
      const toward = this.camera.position.clone().sub(this.controls.target).normalize();
      const right = new Vector3().fromArray(this.scene.up).cross(toward).normalize();
      stick.look([right, toward.clone().cross(right), toward]);
      stick.frame(spheresOf(this.scene, this.framed));
    }
    stick.pose(this.last);
    return stick.svg;
  }
}
