// Solids and coils as three.js draws them.
//
// Light is painted on once, for the nominal position: bodies hardly turn, and browsers without a graphics processor then draw
// one and a half times as many frames (docs/benchmarks.md).

import {
  BufferAttribute,
  BufferGeometry,
  CatmullRomCurve3,
  Color,
  DoubleSide,
  EdgesGeometry,
  Euler,
  FrontSide,
  Group,
  LatheGeometry,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  TubeGeometry,
  Vector2,
  Vector3,
} from "three";

import type { Coil, Role, Solid, Triple } from "../contract.js";

const LOOKS: Record<Role, { colour: number; opacity: number; edge: number }> = {
  wedge: { colour: 0xcdd5dc, opacity: 1, edge: 0x3b444c },
  column: { colour: 0x7da3bf, opacity: 0.26, edge: 0x4d7591 },
  pocket: { colour: 0xc9ad7f, opacity: 0.22, edge: 0x8a6d3b },
  seat: { colour: 0x8f989f, opacity: 0.7, edge: 0x5a6167 },
  wheelset: { colour: 0xa8b0b7, opacity: 0.16, edge: 0x9aa2a9 },
  wheel: { colour: 0x7da3bf, opacity: 0.55, edge: 0x4d7591 },
  body: { colour: 0xa8b0b7, opacity: 0.5, edge: 0x5a6167 },
  glass: { colour: 0xa8b0b7, opacity: 0.14, edge: 0x5a6167 },
  lading: { colour: 0xb08d57, opacity: 0.32, edge: 0x6f5630 },
};

const SUN = new Vector3(0.45, -0.75, 0.5).normalize();

/** Colours the corners of a geometry by how they face the light. */
export function paint(geometry: BufferGeometry, colour: number): void {
  const base = new Color(colour);
  const normals = geometry.getAttribute("normal");
  const normal = new Vector3();
  const colours = new Float32Array(3 * normals.count);
  for (let k = 0; k < normals.count; k++) {
    const light = 0.62 + 0.38 * normal.fromBufferAttribute(normals, k).dot(SUN);
    base.clone().multiplyScalar(light).toArray(colours, 3 * k);
  }
  geometry.setAttribute("color", new BufferAttribute(colours, 3));
}

/** R = Ry(pitch) Rz(yaw) Rx(roll). */
export function turn([roll, pitch, yaw]: Triple): Euler {
  return new Euler(roll, pitch, yaw, "YZX");
}

/** Sides of a body of revolution, and the lines along its outline that show how it spins. */
const SIDES = 64;
const SPOKES = 6;

/** A body of revolution about y. Its light does not depend on its turn: it spins. */
function revolvedMesh(outline: [number, number][], look: (typeof LOOKS)[Role]): Group {
  const geometry = new LatheGeometry(
    outline.map(([y, radius]) => new Vector2(radius, y)),
    SIDES,
  );
  const base = new Color(look.colour);
  const normals = geometry.getAttribute("normal");
  const colours = new Float32Array(3 * normals.count);
  for (let k = 0; k < normals.count; k++) {
    const light = 0.72 + 0.28 * Math.abs(normals.getY(k));
    base.clone().multiplyScalar(light).toArray(colours, 3 * k);
  }
  geometry.setAttribute("color", new BufferAttribute(colours, 3));
  const clear = look.opacity < 1;
  const material = new MeshBasicMaterial({
    vertexColors: true,
    transparent: clear,
    opacity: look.opacity,
    depthWrite: !clear,
    side: DoubleSide,
    forceSinglePass: true,
  });
  const lines: Vector3[] = [];
  const at = ([y, radius]: [number, number], angle: number): Vector3 =>
    new Vector3(radius * Math.sin(angle), y, radius * Math.cos(angle));
  outline.forEach((point, k) => {
    const next = outline[k + 1];
    if (!next) {
      return;
    }
    for (let spoke = 0; spoke < SPOKES; spoke++) {
      const angle = (2 * Math.PI * spoke) / SPOKES;
      lines.push(at(point, angle), at(next, angle));
    }
    // A circle where the outline turns by much.
    const before = outline[k - 1];
    if (before && turned(before, point, next) > 0.6) {
      for (let side = 0; side < SIDES; side++) {
        lines.push(at(point, (2 * Math.PI * side) / SIDES), at(point, (2 * Math.PI * (side + 1)) / SIDES));
      }
    }
  });
  const edges = new LineSegments(new BufferGeometry().setFromPoints(lines), new LineBasicMaterial({ color: look.edge }));
  const group = new Group();
  group.add(new Mesh(geometry, material), edges);
  return group;
}

/** The angle by which an outline turns at its middle point. */
function turned(a: [number, number], b: [number, number], c: [number, number]): number {
  const along = new Vector2(b[0] - a[0], b[1] - a[1]);
  const on = new Vector2(c[0] - b[0], c[1] - b[1]);
  return Math.abs(along.angleTo(on));
}

/** A solid in the axes of its mount. */
export function solidMesh(solid: Solid): Group {
  const look = LOOKS[solid.role];
  if (solid.revolved) {
    const group = revolvedMesh(solid.revolved, look);
    group.name = solid.id;
    return group;
  }
  const corners = solid.triangles.flatMap((triangle) => triangle.flatMap((corner) => solid.vertices[corner] ?? [0, 0, 0]));
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(Float32Array.from(corners), 3));
  geometry.computeVertexNormals();
  paint(geometry, look.colour);
  const clear = look.opacity < 1;
  const material = new MeshBasicMaterial({
    vertexColors: true,
    transparent: clear,
    opacity: look.opacity,
    depthWrite: !clear,
    side: clear ? DoubleSide : FrontSide,
    // Backs and fronts together: half the calls, and behind glass of one colour the order is not seen.
    forceSinglePass: true,
    polygonOffset: true,
    // Where faces touch, that of the wedge is in front.
    polygonOffsetFactor: clear ? 4 : 1,
    polygonOffsetUnits: clear ? 4 : 1,
  });
  const edges = new LineSegments(new EdgesGeometry(geometry, 1), new LineBasicMaterial({ color: look.edge }));
  const group = new Group();
  group.add(new Mesh(geometry, material), edges);
  group.name = solid.id;
  return group;
}

/** A coil of length 1 along z, from the origin; its wire is round at the nominal length. One of many is drawn with fewer faces. */
export function coilMesh(coil: Coil, many: boolean): Mesh {
  const steps = Math.round(coil.turns * (many ? 12 : 20));
  const wire = coil.radius * 0.14;
  const points = Array.from({ length: steps + 1 }, (_, k) => {
    const share = k / steps;
    const angle = 2 * Math.PI * coil.turns * share;
    const z = wire + share * (coil.nominal_length - 2 * wire);
    return new Vector3(coil.radius * Math.cos(angle), coil.radius * Math.sin(angle), z);
  });
  const geometry = new TubeGeometry(new CatmullRomCurve3(points), steps, wire, many ? 4 : 6);
  paint(geometry, 0x8d979f);
  geometry.scale(1, 1, 1 / coil.nominal_length);
  const mesh = new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true }));
  mesh.name = coil.name;
  return mesh;
}
