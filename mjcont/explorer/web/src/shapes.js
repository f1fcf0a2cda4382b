// Shapes of a model as three.js draws them. Lengths in m; a shape stands on its body, MuJoCo's axes throughout.

import {
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  CapsuleGeometry,
  Color,
  CylinderGeometry,
  DoubleSide,
  FrontSide,
  Mesh,
  MeshStandardMaterial,
  PlaneGeometry,
  SphereGeometry,
  SRGBColorSpace,
  TubeGeometry,
  Curve,
  Vector3,
} from "three";

const UNIT = { cylinder: null, sphere: null };
const COILS = 7;

/** Return the meshes of a scene decoded as geometries. */
export function geometriesOf(meshes) {
  return meshes.map(({ vertices, faces }) => {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(vertices, 3));
    geometry.setIndex(new BufferAttribute(faces, 1));
    // flat between faces that meet at an edge, smooth elsewhere: a copy a face, its own normals
    const flat = geometry.toNonIndexed();
    flat.computeVertexNormals();
    return flat;
  });
}

/** Return a shape as an object; `size` is set by `resize`. */
export function objectOf(geom, geometries) {
  const mesh = new Mesh(geometryOf(geom, geometries), materialOf(geom.rgba, geom.type === "plane"));
  mesh.position.fromArray(geom.pos);
  const [w, x, y, z] = geom.quat;
  mesh.quaternion.set(x, y, z, w);
  resize(mesh, geom, geom.size);
  return mesh;
}

/** Give a shape another size; a capsule is made anew. */
export function resize(mesh, geom, size) {
  const [a, b, c] = size;
  if (geom.type === "sphere") mesh.scale.setScalar(a);
  else if (geom.type === "ellipsoid") mesh.scale.set(a, b, c);
  else if (geom.type === "cylinder") mesh.scale.set(a, a, b);
  else if (geom.type === "box") mesh.scale.set(2 * a, 2 * b, 2 * c);
  else if (geom.type === "capsule" && (mesh.userData.a !== a || mesh.userData.b !== b)) {
    mesh.geometry.dispose();
    mesh.geometry = new CapsuleGeometry(a, 2 * b, 8, 20).rotateX(Math.PI / 2);
    Object.assign(mesh.userData, { a, b });
  }
}

function geometryOf(geom, geometries) {
  if (geom.type === "mesh") return geometries[geom.mesh];
  if (geom.type === "plane") return new PlaneGeometry(2 * geom.size[0], 2 * geom.size[1]);
  if (geom.type === "box") return new BoxGeometry(1, 1, 1);
  if (geom.type === "cylinder") return (UNIT.cylinder ??= new CylinderGeometry(1, 1, 2, 28).rotateX(Math.PI / 2));
  if (geom.type === "capsule") return new BufferGeometry();
  return (UNIT.sphere ??= new SphereGeometry(1, 40, 26));
}

export function materialOf([r, g, b, a], ground = false) {
  return new MeshStandardMaterial({
    color: new Color().setRGB(r, g, b, SRGBColorSpace),
    roughness: 0.62,
    metalness: 0.08,
    transparent: a < 1 || ground,
    opacity: ground ? Math.min(a, 0.5) : a,
    side: ground ? DoubleSide : FrontSide,
  });
}

class Helix extends Curve {
  getPoint(t, target = new Vector3()) {
    const angle = 2 * Math.PI * COILS * t,
      r = Math.min(1, 12 * t, 12 * (1 - t));
    return target.set(r * Math.cos(angle), r * Math.sin(angle), t - 0.5);
  }
}

/** Springs as coils, cables as rods, along a path of points that changes with every pose. */
export class Tendons {
  constructor(tendons, parent) {
    this.legs = [];
    let at = 0;
    for (const t of tendons) {
      const material = materialOf(t.rgba);
      for (let i = 0; i + 1 < t.points; i++) {
        const rod = new Mesh((UNIT.cylinder ??= new CylinderGeometry(1, 1, 2, 28).rotateX(Math.PI / 2)), material);
        const coil =
          t.spring && t.points === 4 && i === 0
            ? new Mesh(new TubeGeometry(new Helix(), 160, 0.22, 6), material)
            : null;
        parent.add(rod);
        if (coil) parent.add(coil);
        this.legs.push({ rod, coil, at: at + i, width: t.width });
      }
      at += t.points;
    }
    this.along = new Vector3();
    this.axis = new Vector3(0, 0, 1);
  }

  pose(points) {
    for (const { rod, coil, at, width } of this.legs) {
      const [x0, y0, z0, x1, y1, z1] = points.subarray(3 * at, 3 * at + 6);
      this.along.set(x1 - x0, y1 - y0, z1 - z0);
      const length = this.along.length(),
        there = length > 1e-9;
      rod.visible = there;
      if (coil) coil.visible = there;
      if (!there) continue;
      this.along.divideScalar(length);
      for (const part of coil ? [rod, coil] : [rod]) {
        part.position.set((x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2);
        part.quaternion.setFromUnitVectors(this.axis, this.along);
      }
      rod.scale.set(coil ? 0.4 * width : width, coil ? 0.4 * width : width, length / 2);
      coil?.scale.set(2.6 * width, 2.6 * width, 0.84 * length);
    }
  }
}
