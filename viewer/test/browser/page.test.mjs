// The report's page in a real browser. WEDGELAB_REPORT: the folder that `wedgelab reproduce` wrote; WEDGELAB_CHROMIUM: the browser.
import assert from "node:assert/strict";
import { readFileSync, statSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";
import { parts } from "./seen.mjs";

const folder = process.env.WEDGELAB_REPORT;
assert.ok(folder, "WEDGELAB_REPORT names the folder of a report");
const file = join(folder, "index.html");
const address = pathToFileURL(file).href;

/** The stand-alone run with lift-off; its nominal coil length is 10.25 in. */
const RUN = "vdrun_toe_0_psi_0.012";
const ANCHOR = `#run-${RUN.replaceAll(".", "_")}`;
const NOMINAL = 10.25;
const INCH = 0.0254;
/** A half-truck whose bolster is yawed: everything moves. */
const TRUCK = "nucars_69_variable_toe_out_yaw";

let browser;
let faults = [];

before(async () => {
  browser = await chromium.launch({
    executablePath: process.env.WEDGELAB_CHROMIUM ?? "/usr/bin/chromium",
    args: [
      "--no-sandbox",
      "--disable-gpu",
      "--use-gl=angle",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      "--disable-quic",
      "--no-first-run",
      "--disable-background-networking",
      "--disable-component-update",
      "--disable-sync",
    ],
  });
});

after(async () => {
  await browser?.close();
});

/** A page on which every complaint, and every look at the network, is noted. */
async function open(hash = "", size = { width: 1280, height: 900 }, at = address) {
  faults = [];
  const page = await browser.newPage({ viewport: size });
  page.on("pageerror", (error) => faults.push(String(error)));
  page.on("console", (message) => {
    // Drivers in software say so of every picture that is copied to the screen.
    if (["error", "warning"].includes(message.type()) && !message.text().includes("GPU stall due to ReadPixels")) {
      faults.push(message.text());
    }
  });
  page.on("request", (request) => request.url().startsWith("http") && faults.push(request.url()));
  await page.goto(at + hash);
  await page.waitForSelector("html[data-viewer=ready]", { state: "attached" });
  return page;
}

async function openRun(size, name = RUN) {
  const page = await open(name === RUN ? ANCHOR : `#run-${name.replaceAll(".", "_")}`, size);
  const run = page.locator(`details[data-run="${name}"] .wl-run`);
  await run.and(page.locator("[data-ready]")).waitFor();
  return { page, run };
}

/** What a run's view says of itself. */
const state = (run) => run.evaluate((element) => ({ ...element.dataset }));

/** Moves the scrubber. */
const scrub = (run, time) =>
  run.locator(".wl-scrubber").evaluate((slider, to) => {
    slider.value = String(to);
    slider.dispatchEvent(new Event("input"));
  }, time);

/** The columns of `result.csv`. */
function table(run) {
  const [head, ...lines] = readFileSync(join(folder, "runs", run, "result.csv"), "utf8").trim().split("\n");
  const rows = lines.map((line) => line.split(",").map(Number));
  return Object.fromEntries(head.split(",").map((name, k) => [name, rows.map((row) => row[k])]));
}

/** Counts the canvas's pixels by what they look like, all and in a part of it (shares of its width and height). */
async function pixels(page, run, [left, top, right, bottom] = [0, 0, 1, 1]) {
  // A picture of something at rest is drawn finely a moment later.
  await page.waitForTimeout(900);
  const picture = await run.locator("canvas").first().screenshot();
  return page.evaluate(
    async ([data, [x0, y0, x1, y1]]) => {
      const image = new Image();
      image.src = `data:image/png;base64,${data}`;
      await image.decode();
      const canvas = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height });
      const context = canvas.getContext("2d");
      context.drawImage(image, 0, 0);
      const [x, y] = [Math.floor(x0 * image.width), Math.floor(y0 * image.height)];
      const [w, h] = [Math.floor((x1 - x0) * image.width), Math.floor((y1 - y0) * image.height)];
      const bytes = context.getImageData(x, y, w, h).data;
      const near = (k, [r, g, b]) => Math.abs(bytes[k] - r) + Math.abs(bytes[k + 1] - g) + Math.abs(bytes[k + 2] - b) < 40;
      const count = { all: w * h, empty: 0, normal: 0, friction: 0, slip: 0, open: 0 };
      for (let k = 0; k < bytes.length; k += 4) {
        count.empty += near(k, [0xf7, 0xf9, 0xfb]) ? 1 : 0;
        count.normal += near(k, [0x00, 0x72, 0xb2]) ? 1 : 0;
        count.friction += near(k, [0xd5, 0x5e, 0x00]) ? 1 : 0;
        count.slip += near(k, [0xe6, 0x9f, 0x00]) ? 1 : 0;
        count.open += near(k, [0x56, 0xb4, 0xe9]) ? 1 : 0;
      }
      return count;
    },
    [picture.toString("base64"), [left, top, right, bottom]],
  );
}

// How long it takes depends on the machine, and is only told; what makes it long is counted.
test("the page opens from disk with bounded size, without complaints and without network", async (t) => {
  const page = await open();
  const opened = await page.evaluate(() => performance.getEntriesByType("navigation")[0].domComplete);
  const megabytes = statSync(file).size / 1e6;
  const { elements, canvases } = await parts(page);
  t.diagnostic(`opens in ${opened.toFixed(0)} ms; ${megabytes.toFixed(1)} MB, ${elements} elements, ${canvases} canvases`);
  await page.waitForTimeout(500);
  assert.deepEqual(faults, []);
  assert.ok(megabytes <= 10, `${megabytes} MB`);
  assert.ok(elements <= 30_000, `${elements} elements`);
  // Of one run: two plots, the loop, the picture.
  assert.ok(canvases <= 4, `${canvases} canvases`);
  await page.close();
});

test("the page begins with a run in 3D, its loop, key numbers, and how many statements hold", async () => {
  const page = await open();
  const first = page.locator("main section").first();
  await first.locator(".wl-run[data-ready]").waitFor();
  assert.ok(await first.locator(".wl-loop canvas").isVisible());
  const { claims } = JSON.parse(readFileSync(join(folder, "claims.json"), "utf8"));
  const hold = claims.filter(({ verdict }) => verdict === "holds").length;
  const tiles = await first.locator(".tiles").innerText();
  assert.ok(tiles.includes(`${hold} of ${claims.length}`), tiles);
  const { averages } = JSON.parse(readFileSync(join(folder, "runs", RUN, "summary.json"), "utf8"));
  for (const branch of ["up", "down"]) {
    const { value, unit } = averages[branch].vertical_wedge_force;
    assert.match(tiles.replaceAll("\u2212", "-"), new RegExp(`${value.toFixed(0)} ${unit}\\s+mean vertical wedge force, bolster going ${branch}`));
  }
  assert.deepEqual(faults, []);
  await page.close();
});

test("an address with a run opens its view; closing it takes the view away", async () => {
  const { page, run } = await openRun();
  await page.waitForTimeout(800);
  assert.deepEqual(faults, []);
  assert.equal(await run.locator(".wl-plot").count(), 2);
  assert.equal(await run.locator(".wl-loop").count(), 1);
  await page.locator(`details[data-run="${RUN}"] > summary`).click();
  await run.waitFor({ state: "detached" });
  assert.equal(await page.locator("details .wl-run, details .wl-stage canvas").count(), 0);
  await page.close();
});

test("the canvas shows wedge, column, pocket and coil", async () => {
  const { page, run } = await openRun();
  const all = await pixels(page, run);
  assert.ok(all.empty > 0.4 * all.all && all.empty < 0.9 * all.all, JSON.stringify(all));
  // The wedge is in the middle of the upper half, the coil below it; the upper corners are empty.
  const wedge = await pixels(page, run, [0.4, 0.25, 0.6, 0.5]);
  const coil = await pixels(page, run, [0.4, 0.65, 0.65, 0.95]);
  const corner = await pixels(page, run, [0, 0, 0.1, 0.1]);
  assert.ok(wedge.empty < 0.1 * wedge.all, `wedge ${JSON.stringify(wedge)}`);
  assert.ok(coil.empty > 0.1 * coil.all && coil.empty < 0.9 * coil.all, `coil ${JSON.stringify(coil)}`);
  assert.equal(corner.empty, corner.all);
  await page.close();
});

test("at a time, wedge, plots and playhead are where the table says", async () => {
  const { page, run } = await openRun();
  await run.getByLabel("exaggeration").selectOption("1");
  const columns = table(RUN);
  const heights = [];
  for (const row of [137, 236, 551, 860]) {
    const time = columns.time_s[row];
    await scrub(run, time);
    const now = await state(run);
    assert.ok(Math.abs(Number(now.time) - time) < 1e-4);
    const [x, y, z] = JSON.parse(now.places).wedge;
    assert.ok(Math.abs(x - columns.wedge_x_in[row] * INCH) < 1e-5, `x at ${time}`);
    assert.ok(Math.abs(y) < 1e-5);
    assert.ok(Math.abs(z - (NOMINAL + columns.wedge_z_in[row]) * INCH) < 1e-5, `z at ${time}`);
    heights.push({ z, pixel: JSON.parse(now.pixels).wedge[1] });
    const told = await run.locator('output[data-column="vertical_wedge_force"]').textContent();
    const value = Number(told.replace("\u2212", "-").replace(" lbf", ""));
    const wanted = columns.vertical_wedge_force_lbf[row];
    assert.ok(Math.abs(value - wanted) <= 5e-4 * Math.abs(wanted) + 1e-3, `${told} is not ${wanted}`);
    // The axis shows the whole run.
    const share = await run
      .locator(".wl-plot")
      .first()
      .evaluate((plot) => {
        const over = plot.querySelector(".u-over").getBoundingClientRect();
        const head = plot.querySelector(".wl-playhead").getBoundingClientRect();
        return (head.left + 0.5 * head.width - over.left) / over.width;
      });
    assert.ok(Math.abs(share - time / columns.time_s.at(-1)) < 0.006, `playhead at ${share}`);
  }
  // On the screen, higher is up: the order of the heights is that of the pixels turned round.
  const byHeight = [...heights].sort((a, b) => a.z - b.z).map(({ pixel }) => pixel);
  assert.deepEqual(byHeight, [...byHeight].sort((a, b) => b - a));
  await page.close();
});

test("a click in a plot moves the wedge", async () => {
  const { page, run } = await openRun();
  const over = run.locator(".wl-plot .u-over").first();
  const box = await over.boundingBox();
  await page.mouse.click(box.x + 0.75 * box.width, box.y + 0.5 * box.height);
  const end = table(RUN).time_s.at(-1);
  const now = await state(run);
  assert.ok(Math.abs(Number(now.time) - 0.75 * end) < 0.01 * end, now.time);
  await page.close();
});

test("arrows are there while a corner touches, and not when it is open", async () => {
  const { page, run } = await openRun();
  const columns = table(RUN);
  const contacts = Object.keys(columns).filter((name) => name.endsWith("_state")).map((name) => name.replace(/_state$/, ""));
  assert.equal(contacts.length, 8);
  const touching = (row) => contacts.filter((name) => columns[`${name}_state`][row] > 0);
  const count = columns.time_s.map((_, row) => touching(row).length);
  const free = count.findIndex((n, row) => n === 0 && row > 50 && count[row - 1] === 0 && count[row + 1] === 0);
  // Not in the first moments, where large forces reach out of the picture.
  const load = columns.longitudinal_wedge_force_lbf;
  const held = load.reduce((best, force, row) => (row > 150 && force > load[best] ? row : best), 150);
  assert.ok(free > 0 && held > 0, "the run lifts off and touches");
  for (const row of [free, held]) {
    await scrub(run, columns.time_s[row]);
    const now = await state(run);
    assert.deepEqual(now.visibleArrows.split(" ").filter(Boolean).sort(), touching(row).sort());
    assert.deepEqual(now.states.split(" ").map(Number), contacts.map((name) => columns[`${name}_state`][row]));
    const seen = await pixels(page, run);
    if (row === free) {
      assert.equal(seen.normal + seen.friction, 0, JSON.stringify(seen));
      assert.ok(seen.open > 50, JSON.stringify(seen));
    } else {
      assert.ok(seen.normal > 100 && seen.friction > 30, JSON.stringify(seen));
    }
  }
  // One that closes between two output times appears there.
  const name = contacts.find((own) => columns[`${own}_state`][held] > 0);
  const closing = columns.time_s.findIndex((_, row) => row > 100 && columns[`${name}_state`][row] === 0 && columns[`${name}_state`][row + 1] > 0);
  for (const [row, there] of [[closing, false], [closing + 1, true]]) {
    await scrub(run, columns.time_s[row]);
    assert.equal((await state(run)).visibleArrows.split(" ").includes(name), there, `${name} at ${columns.time_s[row]}`);
  }
  await page.close();
});

test("exaggeration turns the column as it says, and says so", async () => {
  const { page, run } = await openRun();
  assert.match(await run.locator(".wl-told").textContent(), /10×/);
  const before = await run.locator("canvas").first().screenshot();
  await run.getByLabel("exaggeration").selectOption("50");
  assert.match(await run.locator(".wl-told").textContent(), /50×/);
  await page.waitForTimeout(600);
  assert.ok(!before.equals(await run.locator("canvas").first().screenshot()));
  await run.getByLabel("exaggeration").selectOption("1");
  assert.match(await run.locator(".wl-told").textContent(), /To scale/);
  await page.close();
});

test("units switch in plots, scene and figures", async () => {
  const { page, run } = await openRun();
  const columns = table(RUN);
  const row = 551;
  await scrub(run, columns.time_s[row]);
  await page.locator(".wl-units").click();
  const told = await run.locator('output[data-column="vertical_wedge_force"]').textContent();
  assert.match(told, / N$/);
  const newtons = Number(told.replace("\u2212", "-").replace(" N", ""));
  const wanted = columns.vertical_wedge_force_lbf[row] * 4.4482216152605;
  assert.ok(Math.abs(newtons - wanted) <= 5e-4 * Math.abs(wanted) + 1e-3, `${told} is not ${wanted}`);
  assert.match(await run.locator(".wl-key").textContent(), / N/);
  assert.equal((await state(run)).units, "si");
  await run.getByLabel("inch-pound or SI").click();
  assert.match(await run.locator(".wl-key").textContent(), / lbf/);
  await page.close();
});

test("keys play, step, look, exaggerate and switch units", async () => {
  const { page, run } = await openRun();
  await run.evaluate((element) => element.focus());
  const press = async (...keys) => {
    for (const key of keys) {
      await page.keyboard.press(key);
    }
    return state(run);
  };
  assert.equal((await press("ArrowRight", "ArrowRight")).time, "0.0200");
  assert.equal((await press("ArrowLeft")).time, "0.0100");
  assert.equal((await press("Shift+ArrowRight")).time, "0.1100");
  assert.equal(Number((await press("End")).time), table(RUN).time_s.at(-1));
  assert.equal((await press("Home")).time, "0.0000");
  assert.equal((await press("e")).factor, "20");
  assert.equal((await press("Shift+E")).factor, "10");
  assert.equal((await press("u")).units, "si");
  const oblique = await run.locator("canvas").first().screenshot();
  await press("2");
  await page.waitForTimeout(600);
  assert.ok(!oblique.equals(await run.locator("canvas").first().screenshot()), "another view");
  await press("f");
  assert.ok(await run.evaluate((element) => element.getBoundingClientRect().height >= window.innerHeight - 1));
  await press("Escape");
  assert.equal((await press(" ")).playing, "true");
  await page.waitForTimeout(700);
  const later = await press(" ");
  assert.equal(later.playing, "false");
  assert.ok(Number(later.time) > 0.2 && Number(later.time) < 5, later.time);
  await page.waitForTimeout(200);
  assert.equal((await state(run)).time, later.time);
  assert.deepEqual(faults, []);
  await page.close();
});

for (const [what, name] of [["wedge", RUN], ["half-truck", TRUCK]]) {
  test(`playing a ${what} at 1280 by 720 without a graphics processor`, async (t) => {
    const { page, run } = await openRun({ width: 1300, height: 760 }, name);
    await page.addStyleTag({ content: ".wl-stage { position: fixed !important; left: 0; top: 0; width: 1280px; height: 720px; z-index: 20; }" });
    await page.waitForTimeout(600);
    await run.evaluate((element) => element.focus());
    await page.keyboard.press(" ");
    await page.waitForTimeout(5000);
    const { frameRate, playing } = await state(run);
    const size = await run.locator("canvas").first().evaluate((canvas) => `${canvas.width}x${canvas.height}`);
    t.diagnostic(`${frameRate} frames a second at ${size}`);
    assert.equal(size, "1280x720");
    assert.equal(playing, "true");
    // 30 on an idle machine (docs/benchmarks.md); others may be busy.
    assert.ok(Number(frameRate) >= 8, frameRate);
    await page.close();
  });
}

test("a half-truck is there with bolster, side frames, four wedges, springs and coils", async () => {
  const { page, run } = await openRun(undefined, TRUCK);
  assert.deepEqual(faults, []);
  const names = Object.keys(JSON.parse((await state(run)).places));
  assert.deepEqual(names, ["body_1", "body_3", "body_4", "wedge_127", "wedge_128", "wedge_129", "wedge_130"]);
  // Along the track: the two side frames stand left and right, the bolster lies between them, the upper corners are empty.
  await run.evaluate((element) => element.focus());
  await page.keyboard.press("3");
  const filled = async (part) => {
    const seen = await pixels(page, run, part);
    return 1 - seen.empty / seen.all;
  };
  const { pixels: places } = await state(run).then((now) => ({ pixels: JSON.parse(now.pixels) }));
  const { width, height } = await run.locator("canvas").first().boundingBox();
  const about = ([x, y]) => [x / width - 0.04, y / height - 0.04, x / width + 0.04, y / height + 0.04];
  const [left, right] = [places.wedge_127, places.wedge_128];
  const middle = [(left[0] + right[0]) / 2, (left[1] + right[1]) / 2];
  assert.ok(Math.abs(left[0] - right[0]) > 0.4 * width, JSON.stringify(places));
  for (const place of [left, right, middle]) {
    assert.ok((await filled(about(place))) > 0.5, `${place}`);
  }
  assert.ok((await filled([0, 0, 0.08, 0.08])) < 0.01);
  await page.close();
});

test("at a time, the half-truck's bodies, wedges, forces and plots are where its table says", async () => {
  const { page, run } = await openRun(undefined, TRUCK);
  await run.getByLabel("exaggeration").selectOption("1");
  const columns = table(TRUCK);
  const length = (name, row) => columns[`${name}_in`][row] * INCH;
  const near = (found, wanted, what) => assert.ok(Math.abs(found - wanted) < 2e-5, `${what}: ${found} is not ${wanted}`);
  // The centres of gravity of the files.
  const drawn = { body_1: [-35, 0, 83], body_3: [-35, 39.5, 18], body_4: [-35, -39.5, 18] };
  const seen = [];
  for (const row of [120, 333, 700]) {
    const time = columns.time_s[row];
    await scrub(run, time);
    const now = await state(run);
    assert.ok(Math.abs(Number(now.time) - time) < 1e-4);
    const places = JSON.parse(now.places);
    for (const [body, at] of Object.entries(drawn)) {
      ["x", "y", "z"].forEach((axis, k) => near(places[body][k], at[k] * INCH + length(`${body}_${axis}`, row), `${body} ${axis} at ${time}`));
    }
    // The wedge rises in the pocket, which stands at (8.5, 39.5, -65) in from the bolster's centre, and turns with it.
    const [roll, pitch] = ["roll", "pitch"].map((angle) => columns[`body_1_${angle}_rad`][row]);
    const point = [8.5, 39.5, -65].map((inches) => inches * INCH);
    const up = places.body_1[2] + point[2] + roll * point[1] - pitch * point[0] + length("wedge_127_rise", row);
    assert.ok(Math.abs(places.wedge_127[2] - up) < 1e-4, `wedge at ${time}: ${places.wedge_127[2]} is not ${up}`);
    const states = now.states.split(" ").map(Number);
    const wedges = [127, 128, 129, 130];
    assert.deepEqual(wedges.map((_, k) => states[2 * k]), wedges.map((number) => columns[`wedge_${number}_state`][row]));
    const arrows = now.visibleArrows.split(" ");
    for (const number of wedges) {
      const pressed = columns[`wedge_${number}_state`][row] > 0 && columns[`wedge_${number}_column_normal_force_lbf`][row] > 10;
      assert.equal(arrows.includes(`wedge_${number}_column`), pressed, `wedge ${number} at ${time}`);
    }
    const told = await run.locator('output[data-column="wedge_128_column_friction"]').textContent();
    const value = Number(told.replace("\u2212", "-").replace(" lbf", ""));
    const all = columns.wedge_128_column_friction_lbf;
    const most = Math.max(...all.map(Math.abs));
    assert.ok(Math.abs(value - all[row]) <= 1e-4 * most + 1e-3, `${told} is not ${all[row]}`);
    seen.push(places.body_1[2]);
  }
  assert.ok(Math.max(...seen) - Math.min(...seen) > 0.01, "the bolster moves");
  await page.close();
});

test("the truck's page shows each rig: bodies are where the table says, all corners have states and forces", async () => {
  const name = "truck_warp_axles_variable_rising";
  const page = await open(`#run-${name}`, undefined, pathToFileURL(join(folder, "truck.html")).href);
  const run = page.locator(`details[data-run="${name}"] .wl-run`);
  await run.and(page.locator("[data-ready]")).waitFor();
  await scrub(run, 4.5);
  await run.getByLabel("exaggeration").selectOption("1");
  const said = await state(run);
  assert.equal(said.states.split(" ").length, 32);
  assert.ok(said.states.split(" ").every((one) => ["0", "1", "2"].includes(one)), said.states);
  assert.ok(said.visibleArrows.split(" ").length >= 12, said.visibleArrows);
  const places = JSON.parse(said.places);
  const columns = table(name);
  const row = columns.time_s.findIndex((time) => Math.abs(time - 4.5) < 1e-6);
  for (const [id, stem, place] of [
    ["bolster", "bolster", [0, 0, 22]],
    ["leading_left_wedge", "leading_left", [8.5, 39.5, 18]],
    ["trailing_right_wedge", "trailing_right", [-8.5, -39.5, 18]],
    ["left_side_frame", "left_side_frame", [0, 39.5, 18]],
    ["leading_wheelset", "leading_wheelset", [35, 0, 18]],
  ]) {
    ["x", "y", "z"].forEach((axis, k) => {
      const expected = (place[k] + columns[`${stem}_${axis}_in`][row]) * INCH;
      assert.ok(Math.abs(places[id][k] - expected) < 2e-6, `${id} ${axis}: ${places[id][k]} m is not ${expected} m`);
    });
  }
  // The wheelsets have moved by 0.7 in against each other.
  assert.ok(Math.abs(columns.leading_wheelset_y_in[row] - 0.7) < 1e-3);
  const seen = await pixels(page, run);
  assert.ok(seen.empty < 0.9 * seen.all && seen.normal > 50, JSON.stringify(seen));
  assert.deepEqual(faults, []);
  await page.close();
});

test("a run beyond the thesis moves, too", async () => {
  const page = await open();
  const names = await page.locator("details[data-run]").evaluateAll((all) => all.map((own) => own.dataset.run));
  assert.equal(names.length, 82, "every run");
  await page.close();
  const beyond = names.find((own) => own.startsWith("sweep"));
  const { page: other, run } = await openRun(undefined, beyond);
  const columns = table(beyond);
  await run.getByLabel("exaggeration").selectOption("1");
  for (const row of [100, 200]) {
    await scrub(run, columns.time_s[row]);
    const [x, , z] = JSON.parse((await state(run)).places).wedge;
    assert.ok(Math.abs(x - columns.wedge_x_in[row] * INCH) < 1e-5, `x at row ${row}`);
    assert.ok(Number.isFinite(z));
  }
  assert.deepEqual(faults, []);
  await other.close();
});

test("two fingers zoom the 3D view and the plots", async () => {
  const page = await browser.newPage({ viewport: { width: 390, height: 800 }, hasTouch: true });
  await page.goto(address + ANCHOR);
  const run = page.locator(`details[data-run="${RUN}"] .wl-run`);
  await run.and(page.locator("[data-ready]")).waitFor();
  const session = await page.context().newCDPSession(page);
  const pinch = async (target, from, to) => {
    await target.scrollIntoViewIfNeeded();
    const box = await target.boundingBox();
    const at = (spread) => [-0.5, 0.5].map((side) => ({ x: box.x + box.width / 2 + side * spread, y: box.y + box.height / 2 }));
    await session.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: at(from) });
    for (let k = 1; k <= 5; k++) {
      await session.send("Input.dispatchTouchEvent", { type: "touchMove", touchPoints: at(from + ((to - from) * k) / 5) });
    }
    await session.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
    await page.waitForTimeout(300);
  };
  const distance = async () => {
    const [x, y, z] = JSON.parse((await state(run)).eye);
    return Math.hypot(x, y, z);
  };
  const far = await distance();
  await pinch(run.locator("canvas").first(), 60, 180);
  assert.ok((await distance()) < 0.8 * far, `${await distance()} is not nearer than ${far}`);
  const over = run.locator(".wl-plot .u-over").first();
  const ticks = () => run.locator(".wl-plot canvas").first().screenshot();
  const before = await ticks();
  await pinch(over, 50, 150);
  assert.ok(!before.equals(await ticks()), "the plot's time is zoomed");
  assert.equal(await page.evaluate(() => window.visualViewport.scale), 1, "the page is not");
  await page.close();
});

test("a figure in sight is interactive: curves hide, zoom, come back; the drawing is what is printed", async () => {
  const page = await open("#files");
  const figure = page.locator("figure[data-figure]").nth(2);
  assert.ok(await figure.locator(":scope > svg").isVisible(), "far away it is a drawing");
  await figure.scrollIntoViewIfNeeded();
  await page.locator("figure[data-figure].wl-live").first().waitFor();
  const name = await page.locator("figure[data-figure].wl-live").first().getAttribute("data-figure");
  const live = page.locator(`figure[data-figure="${name}"]`);
  assert.ok(!(await live.locator(":scope > svg").isVisible()));
  const canvas = live.locator("canvas").first();
  const before = await canvas.screenshot();
  const entry = live.locator(".wl-entry").first();
  await entry.click();
  assert.equal(await entry.getAttribute("aria-pressed"), "false");
  await page.mouse.move(2, 2);
  assert.ok(!before.equals(await canvas.screenshot()), "a curve is hidden");
  await entry.click();
  const over = live.locator(".u-over").first();
  const box = await over.boundingBox();
  await page.mouse.move(box.x + 0.3 * box.width, box.y + 0.4 * box.height);
  assert.match(await live.locator(".wl-readout").first().textContent(), /\d/, "values are told");
  await page.mouse.down();
  await page.mouse.move(box.x + 0.7 * box.width, box.y + 0.8 * box.height, { steps: 4 });
  await page.mouse.up();
  await page.waitForTimeout(100);
  const zoomed = await canvas.screenshot();
  assert.ok(!before.equals(zoomed), "zoomed in");
  await page.mouse.dblclick(box.x + 0.5 * box.width, box.y + 0.5 * box.height);
  await page.mouse.move(2, 2);
  await page.waitForTimeout(100);
  assert.ok(!zoomed.equals(await canvas.screenshot()), "zoomed out");
  await page.emulateMedia({ media: "print" });
  assert.ok(await live.locator(":scope > svg").isVisible());
  assert.ok(!(await live.locator(".wl-figure").isVisible()));
  await page.emulateMedia({ media: "screen" });
  await live.locator(".wl-switch").click();
  assert.ok(await live.locator(":scope > svg").isVisible(), "the button brings the drawing back");
  assert.deepEqual(faults, []);
  await page.close();
});

test("at a phone's width nothing sticks out", async () => {
  const { page, run } = await openRun({ width: 390, height: 800 });
  const { page: width, run: own } = await page.evaluate(() => ({
    page: document.documentElement.scrollWidth,
    run: document.querySelector(".wl-run").scrollWidth - document.querySelector(".wl-run").clientWidth,
  }));
  assert.ok(width <= 390, `${width} px`);
  assert.ok(own <= 0, `${own} px`);
  const canvas = await run.locator("canvas").first().boundingBox();
  assert.ok(canvas.width > 300 && canvas.height > 250);
  await page.close();
});
