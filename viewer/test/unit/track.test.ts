import assert from "node:assert/strict";
import { test } from "node:test";

import { Mesh, Vector3 } from "three";

import type { TrackData } from "../../src/contract.js";
import { Track } from "../../src/scene/track.js";

const RADIUS = 200;
const STEP = 0.25;
const square: [number, number][] = [
  [0.7, -0.1],
  [0.8, -0.1],
  [0.8, 0],
  [0.7, 0],
];
const data: TrackData = {
  from: 0,
  step: STEP,
  samples: {},
  rails: [square, square.map(([y, z]) => [-y, z])],
  ties: [0.5, 1.3, 0.12, -0.2, 0.15],
};

/** A curve to the left, its samples to 32 bits as the page has them. */
function curve(more: Record<string, (distance: number) => number> = {}): Track {
  const of = (value: (distance: number) => number): Float32Array =>
    Float32Array.from({ length: 801 }, (_, k) => value(k * STEP));
  const lists: Record<string, Float32Array> = {
    x: of((s) => RADIUS * Math.sin(s / RADIUS)),
    y: of((s) => RADIUS * (1 - Math.cos(s / RADIUS))),
    z: of(() => 0),
    heading: of((s) => s / RADIUS),
    grade: of(() => 0),
    roll: of(() => -0.05),
    ...Object.fromEntries(Object.entries(more).map(([name, value]) => [name, of(value)])),
  };
  return new Track(data, (name) => lists[name]);
}

test("the axes at a distance lie on the curve and lead along it, the left one down", () => {
  const track = curve();
  for (const s of [0.1, 33.33, 151.7]) {
    const { origin, turn } = track.station(s);
    const place = new Vector3(RADIUS * Math.sin(s / RADIUS), RADIUS * (1 - Math.cos(s / RADIUS)), 0);
    assert.ok(origin.distanceTo(place) < 3e-5, `${s}: ${origin.distanceTo(place)}`);
    const along = new Vector3(1, 0, 0).applyQuaternion(turn);
    assert.ok(along.distanceTo(new Vector3(Math.cos(s / RADIUS), Math.sin(s / RADIUS), 0)) < 1e-6);
    const left = new Vector3(0, 1, 0).applyQuaternion(turn);
    assert.ok(Math.abs(left.z - Math.sin(-0.05)) < 1e-6);
  }
});

/** How far the first mesh of each piece, a left rail, reaches to the left of the center line. */
function leftmost(track: Track): number {
  track.group.updateMatrixWorld(true);
  let far = -Infinity;
  for (const piece of track.group.children) {
    const mesh = piece.children[0] as Mesh;
    const places = mesh.geometry.getAttribute("position");
    for (let k = 0; k < places.count; k++) {
      const place = new Vector3().fromBufferAttribute(places, k).applyMatrix4(mesh.matrixWorld);
      far = Math.max(far, RADIUS - Math.hypot(place.x, place.y - RADIUS));
    }
  }
  return far;
}

test("rails are drawn near what is looked at only, and irregularities grow by the factor", () => {
  const track = curve({ left_lateral: () => 0.01 });
  track.show(100, 1);
  const pieces = track.group.children.length;
  assert.ok(pieces >= 7 && pieces <= 9, String(pieces));
  const plain = leftmost(track);
  track.show(100, 10);
  assert.equal(track.group.children.length, pieces);
  const grown = leftmost(track);
  assert.ok(Math.abs(plain - 0.81) < 3e-3, String(plain));
  assert.ok(Math.abs(grown - plain - 0.09) < 1e-3, String(grown));
  track.show(180, 10);
  assert.ok(track.group.children.length < pieces);
  track.dispose();
  assert.equal(track.group.children.length, 0);
});
