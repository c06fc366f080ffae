import assert from "node:assert/strict";
import { test } from "node:test";

import { around, extremes, nearest, rises, tickTexts } from "../../src/plots/curves.js";

test("ticks have the decimals that their step needs", () => {
  const texts = (splits: number[]): string[] => tickTexts(undefined as never, splits);
  assert.deepEqual(texts([0, 2.5, 5, 7.5]), ["0", "2.5", "5.0", "7.5"]);
  assert.deepEqual(texts([-20, -10, 0]), ["\u221220", "\u221210", "0"]);
  assert.deepEqual(texts([0, 0.25, 0.5]), ["0", "0.25", "0.50"]);
  assert.deepEqual(texts([0.1, 0.2, 0.3]), ["0.1", "0.2", "0.3"]);
  assert.deepEqual(texts([0, 2e6]), ["0", "2.0e+6"]);
});

test("ranges have air, and something to show when there is nothing", () => {
  assert.deepEqual(around(0, 10), [-0.5, 10.5]);
  assert.deepEqual(around(Infinity, -Infinity), [0, 1]);
  assert.deepEqual(around(4, 4), [2, 6]);
  const curve = { x: [0, 1, 2, 3], y: [5, NaN, -1, 9] };
  assert.deepEqual(extremes([curve], "y"), [-1, 9]);
  assert.deepEqual(extremes([curve], "y", [0, 2]), [-1, 5]);
});

test("loops turn back, and have a nearest point", () => {
  assert.ok(rises([0, 1, NaN, 1, 2]));
  assert.ok(!rises([0, 1, 0.5]));
  const loop = { x: [0, 1, 0, -1], y: [1, 0, -1, 0] };
  assert.equal(nearest(loop, (x, y) => Math.hypot(x - 0.1, y + 0.8))[0], 2);
});
