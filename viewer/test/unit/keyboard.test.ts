import assert from "node:assert/strict";
import { test } from "node:test";

import { Clock } from "../../src/clock.js";
import { action } from "../../src/keyboard.js";

test("keys do what the help says, and no others", () => {
  const done: string[] = [];
  const clock = new Clock(0, 10);
  const target = {
    clock,
    step: (rows: number) => void done.push(`step ${rows}`),
    look: (view: number) => void done.push(`look ${view}`),
    orbit: () => void done.push("orbit"),
    changeFactor: (by: number) => void done.push(`factor ${by}`),
    nextUnits: () => void done.push("units"),
    flatten: () => void done.push("flat"),
    nameBodies: () => void done.push("names"),
    fill: (on?: boolean) => void done.push(`fill ${on}`),
  };
  const keys: [string, boolean][] = [
    ["ArrowLeft", false],
    ["ArrowRight", true],
    ["1", false],
    ["5", false],
    ["9", false],
    ["w", false],
    ["E", true],
    ["e", false],
    ["u", false],
    ["Escape", false],
  ];
  for (const [key, shift] of keys) {
    action(target, key, shift)?.();
  }
  assert.deepEqual(done, ["step -1", "step 10", "look 0", "look 4", "look 8", "orbit", "factor -1", "factor 1", "units", "fill false"]);
  action(target, "End", false)?.();
  assert.equal(clock.time, 10);
  for (const key of ["0", "Tab", "q", "ArrowUp", "Enter"]) {
    assert.equal(action(target, key, false), undefined, key);
  }
});
