// The pressure over a face with a grid of points, as colours of the face.

import { BufferAttribute, BufferGeometry, Mesh, MeshBasicMaterial } from "three";

import type { Pressure } from "../contract.js";
import type { Instant, RunData } from "../data.js";

/** Colours from no pressure to the greatest one: red, green, blue, and how far they cover what lies behind. */
const RAMP: [number, number, number, number][] = [
  [0.78, 0.88, 1, 0.25],
  [1, 0.93, 0.63, 0.7],
  [0.99, 0.55, 0.24, 0.8],
  [0.7, 0, 0.15, 0.9],
];

/** The same for a legend. */
export const RAMP_STYLE = `linear-gradient(to right, ${RAMP.map(
  ([r, g, b, a]) => `rgb(${[r, g, b].map((part) => Math.round(255 * part)).join(" ")} / ${a})`,
).join(", ")})`;

/** The colour of a pressure relative to the greatest one. */
export function ramp(share: number): [number, number, number, number] {
  const place = Math.min(1, Math.max(0, share)) * (RAMP.length - 1);
  const low = Math.min(Math.floor(place), RAMP.length - 2);
  const part = place - low;
  const [from, to] = [RAMP[low], RAMP[low + 1]];
  return [0, 1, 2, 3].map((k) => (from?.[k] ?? 0) + part * ((to?.[k] ?? 0) - (from?.[k] ?? 0))) as [
    number,
    number,
    number,
    number,
  ];
}

/** A pressure that few points exceed in a run, so that colours tell most of them apart. */
export function typicalPressure(faces: Pressure[], run: RunData): number {
  // The release from the start is none of the motion's.
  const all = faces
    .flatMap(({ pressures }) => pressures)
    .flatMap((name) => [...run.values(name)].slice(Math.floor(run.times.length / 10)))
    .filter((pressure) => pressure > 0)
    .sort((a, b) => a - b);
  return all[Math.floor(0.98 * all.length)] ?? 1;
}

export class PressureMark {
  readonly mesh: Mesh;
  private readonly readers: ((at: Instant) => number)[];
  private readonly colours: BufferAttribute;

  constructor(
    readonly face: Pressure,
    run: RunData,
    private readonly greatest: number,
  ) {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(face.points.flat()), 3));
    this.colours = new BufferAttribute(new Float32Array(4 * face.points.length), 4);
    geometry.setAttribute("color", this.colours);
    const up = face.points.length / face.across;
    const corners: number[] = [];
    for (let place = 0; place + 1 < face.across; place += 1) {
      for (let row = 0; row + 1 < up; row += 1) {
        const at = place * up + row;
        corners.push(at, at + 1, at + up + 1, at, at + up + 1, at + up);
      }
    }
    geometry.setIndex(corners);
    // Seen through everything, as forces are.
    const material = new MeshBasicMaterial({ vertexColors: true, transparent: true, depthTest: false, side: 2 });
    this.mesh = new Mesh(geometry, material);
    this.mesh.renderOrder = 7;
    this.readers = face.pressures.map((name) => run.reader(name));
  }

  /** The pressures at an instant. */
  pressures(at: Instant): number[] {
    return this.readers.map((read) => Math.max(0, read(at)));
  }

  show(at: Instant): void {
    this.pressures(at).forEach((pressure, i) => {
      this.colours.setXYZW(i, ...ramp(pressure / this.greatest));
    });
    this.colours.needsUpdate = true;
  }
}
