import assert from "node:assert/strict";
import { test } from "node:test";

import type { Measured } from "../../src/explorer/api.js";
import { place, quoted, STEPS, typed, valueAt, widened } from "../../src/explorer/numbers.js";

const angle: Measured = { value: 32, unit: "deg", si: 0.5585, kind: "angle", low: 20, high: 55, logarithmic: false, signs: null };
const toe: Measured = { ...angle, value: -0.2, low: -0.4, high: 0.4, signs: ["in", "out"] };
const speed: Measured = { ...angle, value: 1e-3, unit: "in/s", kind: "speed", low: 1e-4, high: 1e-2, logarithmic: true };

test("a slider's ends and middle are the range's", () => {
  for (const measured of [angle, toe]) {
    assert.equal(valueAt(measured, 0), measured.low);
    assert.equal(valueAt(measured, STEPS), measured.high);
    assert.equal(valueAt(measured, STEPS / 2), (measured.low + measured.high) / 2);
  }
  assert.equal(valueAt(speed, STEPS / 2), 1e-3);
});

test("every place of a slider comes back", () => {
  for (const measured of [angle, toe, speed]) {
    for (let at = 0; at <= STEPS; at++) {
      assert.equal(place(measured, valueAt(measured, at)), at);
    }
  }
});

test("values are typed with their units, signs in words", () => {
  assert.equal(typed(angle, 35.5), "35.5 deg");
  assert.equal(typed(toe, -0.1), "0.1 deg in");
  assert.equal(typed(toe, 0.1), "0.1 deg out");
  assert.equal(typed(toe, 0), "0 deg");
  assert.equal(typed({ ...angle, unit: "" }, 0.3), "0.3");
  assert.equal(quoted('a "b"'), '"a \\"b\\""');
});

test("a slider keeps its range until a value is outside it, or has another unit", () => {
  const now = { ...angle, value: 40, low: 10, high: 80 };
  assert.deepEqual([widened(angle, now).low, widened(angle, now).high], [20, 55]);
  assert.equal(widened(angle, { ...now, value: 60 }).high, 80);
  assert.equal(widened(angle, { ...now, unit: "rad" }).high, 80);
});
