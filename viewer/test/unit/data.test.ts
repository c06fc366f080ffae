import assert from "node:assert/strict";
import { test } from "node:test";

import type { ViewDocument } from "../../src/contract.js";
import { Data, decode } from "../../src/data.js";

function encode(values: number[]): string {
  const bytes = Buffer.alloc(4 * values.length);
  values.forEach((value, k) => bytes.writeFloatLE(value, 4 * k));
  return bytes.toString("base64");
}

const view: ViewDocument = {
  schema: "wedgelab.view/1",
  units: "us",
  quantities: {},
  data: [encode([0, 0.5, 1, 2]), encode([1, 2, 4, 8]), encode([0, 0, 2, 1])],
  figures: {},
  runs: [
    {
      name: "a",
      title: "",
      time: 0,
      columns: {
        y: { text: "", quantity: "force", data: 1 },
        state: { text: "", quantity: "count", data: 2 },
        held: { text: "", quantity: "angle", value: 0.25 },
      },
      plots: [],
      scene: null,
    },
  ],
};

test("numbers come back", () => {
  assert.deepEqual([...decode(encode([0, -1.5, 3e7, NaN]))], [0, -1.5, 3e7, NaN]);
});

test("rounded lists are sums of sums of their differences", () => {
  // 3, 5, 4, -300 steps of 0.5: second differences 3, -1, -3, -303, signs in the lowest bit, seven bits a byte.
  const bytes = Buffer.from([6, 1, 5, (605 & 127) | 128, 605 >> 7]);
  assert.deepEqual([...decode({ step: 0.5, differences: bytes.toString("base64") })], [1.5, 2.5, 2, -150]);
});

test("columns are straight between rows, states are those of the row before", () => {
  const run = new Data(view).run("a");
  assert.ok(run);
  const y = run.reader("y");
  const state = run.reader("state", true);
  for (const [time, value, mode] of [
    [-1, 1, 0],
    [0, 1, 0],
    [0.25, 1.5, 0],
    [0.5, 2, 0],
    [0.99, 3.96, 0],
    [1, 4, 2],
    [1.5, 6, 2],
    [2, 8, 1],
    [9, 8, 1],
  ] as const) {
    const at = run.at(time);
    assert.ok(Math.abs(y(at) - value) < 1e-6, `at ${time}: ${y(at)}`);
    assert.equal(state(at), mode, `at ${time}`);
  }
  assert.equal(run.reader("held")(run.at(1)), 0.25);
  assert.deepEqual([...run.values("held")], [0.25, 0.25, 0.25, 0.25]);
  assert.equal(run.end, 2);
});

test("another schema is refused", () => {
  assert.throws(() => new Data({ ...view, schema: "wedgelab.view/2" }), /wedgelab\.view\/1/);
});
