import assert from "node:assert/strict";
import { test } from "node:test";

import type { Run } from "../../src/contract.js";
import { Data } from "../../src/data.js";
import { exaggerated, poser } from "../../src/scene/pose.js";

test("small displacements grow by the factor, large ones to scale", () => {
  assert.equal(exaggerated(0.001, 10, 0.02), 0.01);
  assert.equal(exaggerated(-0.002, 10, 0.02), -0.02);
  assert.ok(Math.abs(exaggerated(0.012, 10, 0.02) - 0.03) < 1e-12);
  assert.ok(Math.abs(exaggerated(-0.012, 10, 0.02) + 0.03) < 1e-12);
  assert.equal(exaggerated(0.012, 1, 0.02), 0.012);
  // It never jumps.
  for (let d = 0; d < 0.01; d += 1e-4) {
    const step = exaggerated(d + 1e-4, 10, 0.02) - exaggerated(d, 10, 0.02);
    assert.ok(step >= 0.99e-4 && step <= 1.001e-3, `${d}: ${step}`);
  }
});

test("steady parts are to scale, angles grow", () => {
  const columns = Object.fromEntries(
    Object.entries({ x: 0.001, z: 0.03, base: 0.029, pitch: 0.002 }).map(([name, value]) => [
      name,
      { text: "", quantity: "length", value },
    ]),
  );
  const run: Run = { name: "a", title: "", time: 0, columns, plots: [], scene: null };
  const data = new Data({ schema: "wedgelab.view/1", units: "si", quantities: {}, data: [""], figures: {}, runs: [run] });
  const pose = poser(
    {
      id: "body",
      position: [1, 2, 3],
      coordinates: ["x", null, "z", null, "pitch", null],
      steady: [null, null, "base"],
    },
    data.run("a") ?? assert.fail(),
  )({ time: 0, row: 0, share: 0 }, 10, 0.02);
  const near = (found: number[], wanted: number[]): void =>
    found.forEach((value, k) => assert.ok(Math.abs(value - (wanted[k] ?? NaN)) < 1e-12, found.join(" ")));
  near(pose.position, [1.01, 2, 3.039]);
  near(pose.angles, [0, 0.02, 0]);
});
