import assert from "node:assert/strict";
import { test } from "node:test";

import type { Measured } from "../../src/explorer/api.js";
import { colour, MOST } from "../../src/explorer/loops.js";
import { place, quoted, shownIn, STEPS, typed, valueAt, widened, words } from "../../src/explorer/numbers.js";

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

const height: Measured = {
  ...angle, value: 6.125, unit: "in", kind: "length", low: 3, high: 12,
  in_si: { text: "0.155575 m", value: 0.155575, unit: "m", low: 0.0762, high: 0.3048 },
};

test("numbers stand in the units that are shown, with their range", () => {
  assert.equal(typed(shownIn(height, "si"), 0.155575), "0.155575 m");
  assert.equal(place(shownIn(height, "si"), 0.155575), place(height, 6.125));
  assert.deepEqual(shownIn(height, "us"), height);
  assert.deepEqual(shownIn(angle, "si"), angle);
});

test("a slider keeps its range when a value is typed in the other units", () => {
  const now: Measured = {
    ...angle, value: 0.2, unit: "m", kind: "length", low: 0.1, high: 0.4,
    in_us: { text: "7.874 in", value: 7.874, unit: "in", low: 3.9, high: 15.7 },
  };
  const kept = widened(height, now);
  assert.deepEqual([kept.low, kept.high, kept.in_us?.low, kept.in_us?.high], [0.0762, 0.3048, 3, 12]);
});

test("paths are told in words", () => {
  assert.equal(words("vertical.0.start_frequency"), "vertical: part 1: start frequency");
  assert.equal(words("vertical.points.2.1"), "vertical: points: point 3: value");
});

test("loops that are shown together have colours of their own, which stay", () => {
  for (let latest = MOST; latest < 40; latest++) {
    const shown = Array.from({ length: MOST }, (_, age) => colour(latest - age));
    assert.equal(new Set(shown).size, MOST);
    assert.ok(shown.every((own) => /^#[0-9a-f]{6}$/.test(own)));
  }
});
