import assert from "node:assert/strict";
import { test } from "node:test";

import { Clock } from "../../src/clock.js";
import { Units, digits } from "../../src/units.js";

test("the clock goes at its speed, and on from the start in a loop", () => {
  const clock = new Clock(1, 3);
  clock.speed = 0.5;
  clock.play(true);
  clock.frame(1000);
  clock.frame(2000);
  assert.equal(clock.time, 1.5);
  clock.frame(6000);
  assert.equal(clock.time, 1.5);
  clock.setLoop(false);
  clock.frame(60_000);
  assert.equal(clock.time, 3);
  assert.equal(clock.playing, false);
  clock.play();
  assert.equal(clock.time, 1, "played again, it begins anew");
});

test("the clock stays within the run, and tells its watchers", () => {
  const clock = new Clock(0, 2);
  const told: number[] = [];
  const stop = clock.watch(() => told.push(clock.time));
  clock.set(7);
  clock.set(-7);
  stop();
  clock.set(1);
  assert.deepEqual(told, [2, 0]);
});

test("speeds have ends", () => {
  const clock = new Clock(0, 1);
  for (let k = 0; k < 20; k++) {
    clock.changeSpeed(-1);
  }
  assert.equal(clock.speed, 0.02);
  for (let k = 0; k < 20; k++) {
    clock.changeSpeed(1);
  }
  assert.equal(clock.speed, 4);
});

test("numbers have four digits and units", () => {
  const quantities = { force: { us: "lbf", si: "N", us_from_si: 0.224809 } };
  assert.equal(new Units(quantities, "us").text(4448.22, "force"), "1000 lbf");
  assert.equal(new Units(quantities, "si").text(-4448.22, "force"), "\u22124448 N");
  assert.equal(digits(0.012345), "0.01235");
  assert.equal(digits(0), "0");
  assert.equal(digits(1.5e-7), "1.50e\u22127");
  assert.equal(digits(NaN), "–");
});
