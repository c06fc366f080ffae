// Places of bodies at an instant, exaggerated as docs/view.md says.

import type { Body, Triple } from "../contract.js";
import type { Instant, RunData } from "../data.js";

/** A small displacement grows by `factor` up to the size `limit`, and to scale beyond it. */
export function exaggerated(displacement: number, factor: number, limit: number): number {
  const size = Math.abs(displacement);
  if (factor <= 1 || size * factor <= limit) {
    return displacement * factor;
  }
  return Math.sign(displacement) * (limit + size - limit / factor);
}

export interface Pose {
  position: Triple;
  /** Roll, pitch, yaw. */
  angles: Triple;
}

export type Poser = (at: Instant, factor: number, limit: number) => Pose;

export function poser(body: Body, run: RunData): Poser {
  const read = body.coordinates.map((name) => run.reader(name));
  const steady = body.steady.map((name) => run.reader(name));
  const along = (k: 0 | 1 | 2, at: Instant, factor: number, limit: number): number => {
    const base = steady[k]?.(at) ?? 0;
    return body.position[k] + base + exaggerated((read[k]?.(at) ?? 0) - base, factor, limit);
  };
  const about = (k: number, at: Instant, factor: number): number => factor * (read[k]?.(at) ?? 0);
  return (at, factor, limit) => ({
    position: [along(0, at, factor, limit), along(1, at, factor, limit), along(2, at, factor, limit)],
    angles: [about(3, at, factor), about(4, at, factor), about(5, at, factor)],
  });
}
