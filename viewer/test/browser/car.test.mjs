// The page of a car's run in a real browser. WEDGELAB: the program; WEDGELAB_CHROMIUM: the browser.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";
import { parts } from "./seen.mjs";

const program = process.env.WEDGELAB;
const skip = program ? false : "WEDGELAB names the program";
const CASE = "curve";
/** Soon in a curve to the left of 7.5 deg with 4 in. */
const TEXT = `model = "car"
speed.value = "28 mph"
start.settle = "1 s"
simulation.duration = "6 s"
[[track.segments]]
tangent = "60 ft"
[[track.segments]]
spiral = "80 ft"
[[track.segments]]
curve = "500 ft"
degree = "7.5 deg"
direction = "left"
superelevation = "4 in"
`;
const INCH = 0.0254;
const FOOT = 0.3048;
const BODIES = ["car_body", "truck_1", "truck_2", "axle_1", "axle_4", "truck_1_bolster", "truck_2_trailing_right_wedge"];

let browser;
let folder;
let page;
let run;
let table;
let opened;
const faults = [];

before(async () => {
  if (skip) {
    return;
  }
  folder = mkdtempSync(join(tmpdir(), "wedgelab-car-"));
  writeFileSync(join(folder, `${CASE}.toml`), TEXT);
  const done = spawnSync(program, ["run", `${CASE}.toml`, "--quiet", "--out", "run", "--tables", "csv"], { cwd: folder, encoding: "utf8" });
  assert.equal(done.status, 0, done.stderr);
  const [head, ...lines] = readFileSync(join(folder, "run", "result.csv"), "utf8").trim().split("\n");
  const rows = lines.map((line) => line.split(",").map(Number));
  table = Object.fromEntries(head.split(",").map((name, k) => [name, rows.map((row) => row[k])]));
  browser = await chromium.launch({
    executablePath: process.env.WEDGELAB_CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
      "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"],
  });
  page = await browser.newPage({ viewport: { width: 1280, height: 900 } });
  page.on("pageerror", (error) => faults.push(String(error)));
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type()) && !message.text().includes("GPU stall due to ReadPixels")) {
      faults.push(message.text());
    }
  });
  page.on("request", (request) => request.url().startsWith("http") && faults.push(request.url()));
  await page.goto(pathToFileURL(join(folder, "run", "index.html")).href);
  run = page.locator(`details[data-run="${CASE}"] .wl-run`);
  await run.and(page.locator("[data-ready]")).waitFor();
  opened = await page.evaluate(() => performance.getEntriesByType("navigation")[0].domComplete);
});

after(async () => {
  await browser?.close();
  if (folder) {
    rmSync(folder, { recursive: true, force: true });
  }
});

const state = () => run.evaluate((element) => ({ ...element.dataset }));

const scrub = (time) =>
  run.locator(".wl-scrubber").evaluate((slider, to) => {
    slider.value = String(to);
    slider.dispatchEvent(new Event("input"));
  }, time);

/** The row of the table at a time, and the places that are drawn then. */
async function at(time) {
  await scrub(time);
  const said = await state();
  const row = table.time_s.findIndex((own) => Math.abs(own - Number(said.time)) < 1e-6);
  assert.ok(row >= 0, said.time);
  return { row, said, places: JSON.parse(said.places) };
}

// How long it takes depends on the machine, and is only told; what makes it long is counted.
test("the page opens with bounded size, without complaints and without network", { skip }, async (t) => {
  const megabytes = statSync(join(folder, "run", "index.html")).size / 1e6;
  const { elements, canvases } = await parts(page);
  t.diagnostic(`opens in ${opened.toFixed(0)} ms; ${megabytes.toFixed(1)} MB, ${elements} elements, ${canvases} canvases`);
  assert.deepEqual(faults, []);
  assert.ok(megabytes <= 3, `${megabytes} MB`);
  assert.ok(elements <= 3_000, `${elements} elements`);
  assert.ok(canvases <= 4, `${canvases} canvases`);
});

test("the car is followed, and its trucks and wheelsets are where the table says", { skip }, async () => {
  for (const time of [0.5, 2.5, 5.9]) {
    const { row, places } = await at(time);
    for (const id of BODIES) {
      assert.ok(id in places, `${id} is missing`);
    }
    assert.ok(Math.abs(places.car_body[0]) < 1e-4, `${places.car_body}`);
    // Along the track between the first and the last axle lie the truck centers and a wheelbase; in a curve of this radius the
    // chord is shorter by 2 mm.
    const apart = Math.hypot(...[0, 1, 2].map((k) => places.axle_1[k] - places.axle_4[k]));
    assert.ok(Math.abs(apart - (486 + 70) * INCH) < 0.02, `${apart} m`);
    // An axle at a distance d beside a tangent to a curve of radius R lies d²/(2R) to the inside, and where the table says.
    const d = places.axle_1[0];
    const radius = (50 * FOOT) / Math.sin((3.75 * Math.PI) / 180);
    const aside = time > 5 ? d ** 2 / (2 * radius) : null;
    if (aside !== null) {
      const expected = aside + table.axle_1_lateral_in[row] * INCH;
      assert.ok(Math.abs(places.axle_1[1] - expected) < 3e-3, `${places.axle_1[1]} m is not ${expected} m`);
    }
  }
});

test("wheels turn, and patches and wedges have their forces", { skip }, async () => {
  const { said } = await at(5.9);
  const arrows = said.visibleArrows.split(" ");
  for (let axle = 1; axle <= 4; axle++) {
    for (const side of ["left", "right"]) {
      assert.ok(arrows.some((own) => own.startsWith(`axle_${axle}_${side}_patch`)), `axle ${axle}, ${side}: ${said.visibleArrows}`);
    }
  }
  assert.equal(arrows.filter((own) => own.includes("_wedge_")).length, 16, said.visibleArrows);
  assert.equal(said.states.split(" ").length, 16);
  assert.match(await page.locator(".wl-run").innerText(), /at wedges, .* at wheels/);
});

test("every look shows something, and playing moves the car", { skip }, async (t) => {
  for (const button of await run.locator(".wl-views button").all()) {
    await button.click();
  }
  await run.locator(".wl-views button").first().click();
  await scrub(0);
  await run.evaluate((element) => element.focus());
  await page.keyboard.press(" ");
  await page.waitForTimeout(2500);
  const { time, frameRate } = await state();
  t.diagnostic(`${frameRate} frames a second`);
  assert.ok(Number(time) > 0.5, time);
  assert.deepEqual(faults, []);
});
