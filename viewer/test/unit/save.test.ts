import assert from "node:assert/strict";
import { test } from "node:test";

import { csv, fileName } from "../../src/save.js";

test("columns become lines; what is missing or not finite is an empty cell", () => {
  const text = csv([
    { name: "time_s", values: [0, 0.1] },
    { name: 'force, "up" (lbf)', values: Float64Array.from([1 / 3, NaN]) },
    { name: "short", values: [2] },
  ]);
  assert.equal(text, 'time_s,"force, ""up"" (lbf)",short\n0,0.333333333,2\n0.1,,\n');
});

test("names of files have no signs that a system refuses", () => {
  assert.equal(fileName("vdrun_toe_0_psi_0.012 at 1.00 s", "png"), "vdrun_toe_0_psi_0.012_at_1.00_s.png");
  assert.equal(fileName("../a/b: c?", "csv"), "a_b_c.csv");
  assert.equal(fileName("…", "csv"), "wedgelab.csv");
});
