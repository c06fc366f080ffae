// The track that bodies run along: its axes at a distance, and its rails and ties near what is looked at.

import { BufferAttribute, BufferGeometry, Euler, Group, Matrix4, Mesh, MeshBasicMaterial, Quaternion, Vector3 } from "three";

import type { TrackData } from "../contract.js";
import { paint } from "./solids.js";

/** Pieces that are drawn at once, m; how much is drawn behind and ahead of what is looked at. */
const PIECE = 16;
const BEHIND = 40;
const AHEAD = 80;
/** Distance of the sections of a rail that are drawn, m. */
const SECTIONS = 0.5;
const RAIL = 0x8d979f;
const TIE = 0xb9a88c;

type Sampled = (name: string) => Float32Array | undefined;

interface Station {
  origin: Vector3;
  turn: Quaternion;
}

interface Piece {
  group: Group;
  factor: number;
}

const railMaterial = (): MeshBasicMaterial => new MeshBasicMaterial({ vertexColors: true, side: 2 });

export class Track {
  /** In the fixed axes. */
  readonly group = new Group();
  private readonly pieces = new Map<number, Piece>();
  private readonly end: number;

  constructor(
    private readonly data: TrackData,
    private readonly sampled: Sampled,
  ) {
    const count = sampled("x")?.length ?? 0;
    this.end = data.from + Math.max(0, count - 1) * data.step;
  }

  /** A list between its samples; zero if there is none. */
  private value(name: string, distance: number): number {
    const list = this.sampled(name);
    if (!list || list.length === 0) {
      return 0;
    }
    const at = Math.min(list.length - 1, Math.max(0, (distance - this.data.from) / this.data.step));
    const row = Math.min(list.length - 2, Math.floor(at));
    const from = list[Math.max(0, row)] ?? 0;
    return from + (at - row) * ((list[row + 1] ?? from) - from);
  }

  /** Origin and axes of the track at a distance: the place by a cubic that leads as the track does. */
  station(distance: number): Station {
    const { from, step } = this.data;
    const low = Math.floor((Math.min(this.end, Math.max(from, distance)) - from) / step);
    const start = from + low * step;
    const t = (distance - start) / step;
    const square = t * t;
    const cube = square * t;
    const weights = [2 * cube - 3 * square + 1, cube - 2 * square + t, 3 * square - 2 * cube, cube - square];
    const place = ["x", "y", "z"].map((name, k) => {
      const slope = (at: number): number => {
        const heading = this.value("heading", at);
        return step * ([Math.cos(heading), Math.sin(heading), this.value("grade", at)][k] ?? 0);
      };
      const values = [this.value(name, start), slope(start), this.value(name, start + step), slope(start + step)];
      return values.reduce((sum, value, k) => sum + value * (weights[k] ?? 0), 0);
    });
    const angles = new Euler(
      this.value("roll", distance),
      -Math.atan(this.value("grade", distance)),
      this.value("heading", distance),
      "ZYX",
    );
    return { origin: new Vector3(...place), turn: new Quaternion().setFromEuler(angles) };
  }

  /** From the axes of the track at a distance to the fixed ones. */
  frame(distance: number): Matrix4 {
    const { origin, turn } = this.station(distance);
    return new Matrix4().compose(origin, turn, new Vector3(1, 1, 1));
  }

  /** Draws what is near a distance; irregularities grow by a factor. */
  show(distance: number, factor: number): void {
    const first = Math.floor((Math.max(this.data.from, distance - BEHIND) - this.data.from) / PIECE);
    const last = Math.floor((Math.min(this.end, distance + AHEAD) - this.data.from) / PIECE);
    for (const [number, piece] of this.pieces) {
      if (number < first || number > last || piece.factor !== factor) {
        this.drop(number, piece);
      }
    }
    for (let number = first; number <= last; number++) {
      if (!this.pieces.has(number)) {
        const group = this.make(number, factor);
        this.pieces.set(number, { group, factor });
        this.group.add(group);
      }
    }
  }

  dispose(): void {
    for (const [number, piece] of this.pieces) {
      this.drop(number, piece);
    }
  }

  private drop(number: number, { group }: Piece): void {
    group.traverse((object) => {
      if (object instanceof Mesh) {
        const mesh = object as Mesh<BufferGeometry, MeshBasicMaterial>;
        mesh.geometry.dispose();
        mesh.material.dispose();
      }
    });
    this.group.remove(group);
    this.pieces.delete(number);
  }

  private make(number: number, factor: number): Group {
    const group = new Group();
    const from = this.data.from + number * PIECE;
    const to = Math.min(this.end, from + PIECE);
    const { origin } = this.station(from);
    // All of a piece is counted from its beginning, so that 32 bits do for a track of any length.
    group.position.copy(origin);
    const count = Math.max(1, Math.ceil((to - from) / SECTIONS));
    const stations = Array.from({ length: count + 1 }, (_, k) => {
      const distance = from + ((to - from) * k) / count;
      const { origin: own, turn } = this.station(distance);
      return { distance, own: own.sub(origin), turn };
    });
    for (const [side, name] of [
      [0, "left"],
      [1, "right"],
    ] as const) {
      const outline = this.data.rails[side];
      const corners: number[] = [];
      for (const { distance, own, turn } of stations) {
        const lateral = factor * this.value(`${name}_lateral`, distance);
        const vertical = factor * this.value(`${name}_vertical`, distance);
        for (const [y, z] of outline) {
          corners.push(...new Vector3(0, y + lateral, z + vertical).applyQuaternion(turn).add(own).toArray());
        }
      }
      group.add(mesh(corners, sleeve(outline.length, count), RAIL));
    }
    const [spacing, length, width, top, thick] = this.data.ties;
    const corners: number[] = [];
    const faces: number[] = [];
    for (let place = Math.ceil(from / spacing) * spacing; place < to; place += spacing) {
      const { origin: own, turn } = this.station(place);
      own.sub(origin);
      const first = corners.length / 3;
      for (const x of [-width, width]) {
        for (const [y, z] of [[-length, top], [-length, top - thick], [length, top - thick], [length, top]] as const) {
          corners.push(...new Vector3(x, y, z).applyQuaternion(turn).add(own).toArray());
        }
      }
      faces.push(...sleeve(4, 1).map((corner) => first + corner));
      faces.push(...[0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7].map((corner) => first + corner));
    }
    group.add(mesh(corners, faces, TIE));
    return group;
  }
}

/** Faces between sections of so many points that follow each other, closed all round. */
function sleeve(points: number, sections: number): number[] {
  const faces: number[] = [];
  for (let section = 0; section < sections; section++) {
    for (let point = 0; point < points; point++) {
      const next = (point + 1) % points;
      const [a, b] = [section * points + point, section * points + next];
      const [c, d] = [a + points, b + points];
      faces.push(a, c, b, b, c, d);
    }
  }
  return faces;
}

function mesh(corners: number[], faces: number[], colour: number): Mesh {
  const shared = new BufferGeometry();
  shared.setAttribute("position", new BufferAttribute(Float32Array.from(corners), 3));
  shared.setIndex(faces);
  // Flat faces: each has its own light.
  const geometry = shared.toNonIndexed();
  shared.dispose();
  geometry.computeVertexNormals();
  paint(geometry, colour);
  return new Mesh(geometry, railMaterial());
}
