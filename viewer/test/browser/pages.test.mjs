// Every kind of page at the widths of a phone, a notebook and a large screen: nothing sticks out, everything can be read, reached with
// keys and named by a screen reader. WEDGELAB: the program; WEDGELAB_REPORT: what `wedgelab reproduce` wrote; WEDGELAB_CHROMIUM: the browser.
/* global getComputedStyle */
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";
import { faint, tooWide, WIDTHS } from "./seen.mjs";

const program = process.env.WEDGELAB;
const skip = program ? false : "WEDGELAB names the program";
const RUNS = [
  ["wedge", "vdrun_toe_0_psi_0.012", ["simulation.duration='3 s'"]],
  ["softer", "vdrun_toe_0_psi_0.012", ["simulation.duration='3 s'", "friction.column=0.3"]],
  ["truck", "truck_vertical_variable", ["simulation.duration='2 s'"]],
  ["car", "car_twist_and_roll_loaded", ["simulation.duration='3 s'", "start.settle='1 s'", "start.kind='equilibrium'"]],
];

let browser;
let folder;
/** Addresses by what they show. */
const pages = new Map();
const faults = [];

function call(...arguments_) {
  const done = spawnSync(program, arguments_, { cwd: folder, encoding: "utf8" });
  assert.equal(done.status, 0, done.stderr);
}

before(async () => {
  if (skip) {
    return;
  }
  folder = mkdtempSync(join(tmpdir(), "wedgelab-pages-"));
  for (const [name, source, set] of RUNS) {
    call("run", source, "--quiet", "--out", name, ...set.flatMap((value) => ["--set", value]));
  }
  call("report", "wedge", "--out", "of-wedge");
  call("report", "wedge", "softer", "truck", "car", "--out", "of-all");
  const at = (...parts) => pathToFileURL(join(...parts, "index.html")).href;
  pages.set("wedge", at(folder, "of-wedge")).set("truck", at(folder, "truck")).set("car", at(folder, "car")).set("report", at(folder, "of-all"));
  if (process.env.WEDGELAB_REPORT) {
    pages.set("reproduction", at(process.env.WEDGELAB_REPORT));
  }
  browser = await chromium.launch({
    executablePath: process.env.WEDGELAB_CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
      "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"],
  });
});

after(async () => {
  await browser?.close();
  if (folder) {
    rmSync(folder, { recursive: true, force: true });
  }
});

async function open(what, width = 1366, options = {}) {
  faults.length = 0;
  const page = await browser.newPage({ viewport: { width, height: 900 }, ...options });
  page.on("pageerror", (error) => faults.push(String(error)));
  page.on("request", (request) => request.url().startsWith("http") && faults.push(request.url()));
  await page.goto(pages.get(what));
  await page.locator(".wl-run[data-ready]").first().waitFor();
  return page;
}

for (const what of ["wedge", "truck", "car", "report", "reproduction"]) {
  test(`issue_036_the page of a ${what} is cut off at no width`, { skip }, async (t) => {
    if (!pages.has(what)) {
      return t.skip("WEDGELAB_REPORT names no report");
    }
    for (const width of WIDTHS) {
      const page = await open(what, width);
      if (width === 1366) {
        const [opened, seen] = await page.evaluate(() => [performance.getEntriesByType("navigation")[0].domComplete, performance.now()]);
        t.diagnostic(`opens in ${opened.toFixed(0)} ms, seen in 3D after ${seen.toFixed(0)} ms`);
      }
      assert.deepEqual(await tooWide(page), [], `${width} px`);
      assert.deepEqual(faults, []);
      if (process.env.WEDGELAB_PICTURES) {
        await page.screenshot({ path: join(process.env.WEDGELAB_PICTURES, `${what}-${width}.png`) });
      }
      await page.close();
    }
  });
}

test("texts have the contrast of WCAG AA on light and on dark paper", { skip }, async () => {
  for (const colorScheme of ["light", "dark"]) {
    for (const what of ["report", "reproduction"].filter((own) => pages.has(own))) {
      const page = await open(what, 1366, { colorScheme });
      const { texts, found } = await faint(page);
      assert.ok(texts > 100, `${texts} texts`);
      assert.deepEqual(found, [], `${what}, ${colorScheme}`);
      const paper = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
      assert.equal(paper, colorScheme === "dark" ? "rgb(20, 24, 28)" : "rgb(255, 255, 255)");
      if (process.env.WEDGELAB_PICTURES) {
        await page.screenshot({ path: join(process.env.WEDGELAB_PICTURES, `${what}-${colorScheme}.png`), fullPage: what === "report" });
      }
      await page.close();
    }
  }
});

test("keys alone reach every part, and what has the focus is seen", { skip }, async () => {
  const page = await open("report");
  const reached = [];
  for (let k = 0; k < 60; k++) {
    await page.keyboard.press("Tab");
    reached.push(
      await page.evaluate(() => {
        const own = document.activeElement;
        const { outlineStyle, outlineWidth } = getComputedStyle(own);
        return { what: `${own.tagName.toLowerCase()}.${own.className}`, name: own.getAttribute("aria-label") ?? own.textContent, seen: outlineStyle !== "none" && parseFloat(outlineWidth) > 0 };
      }),
    );
  }
  for (const [what, name] of [["a.skip", /Skip/], ["a.", /Key numbers/], ["div.wl-run", /Animation/], ["button.", /play/], ["input.wl-scrubber", /time/], ["button.wl-save", /CSV/], ["select.wl-choice", /loop/]]) {
    assert.ok(reached.some((own) => own.what.startsWith(what) && name.test(own.name)), `${what} ${name} is not among ${JSON.stringify(reached.map((own) => own.what))}`);
  }
  assert.deepEqual(reached.filter(({ seen }) => !seen), []);
  // The first stop leads past the contents.
  await page.evaluate(() => document.querySelector(".skip").focus());
  await page.keyboard.press("Enter");
  assert.equal(new URL(page.url()).hash, "#main");
  await page.close();
});

test("what can be used has a name for screen readers, at a phone's width too", { skip }, async () => {
  for (const width of [1366, 390]) {
    const page = await open("report", width);
    const session = await page.context().newCDPSession(page);
    const { nodes } = await session.send("Accessibility.getFullAXTree");
    const roles = new Map();
    for (const { role, name, ignored } of nodes.filter((node) => !node.ignored)) {
      const own = role?.value;
      if (["button", "link", "combobox", "searchbox", "slider", "checkbox", "img", "image", "heading", "navigation", "table"].includes(own)) {
        roles.set(own, (roles.get(own) ?? 0) + 1);
        assert.ok(ignored || own === "table" || name?.value, `a ${own} without a name at ${width} px`);
      }
    }
    for (const role of ["button", "link", "combobox", "slider", "heading", "navigation", "table"]) {
      assert.ok(roles.get(role) > 0, `no ${role} at ${width} px: ${JSON.stringify([...roles])}`);
    }
    // Cards are rows of tables still.
    const cells = nodes.filter((node) => !node.ignored && ["cell", "gridcell"].includes(node.role?.value)).length;
    assert.ok(cells > 20, `${cells} cells at ${width} px`);
    await page.close();
  }
});

test("long tables fold and filter; on a phone rows are cards", { skip }, async () => {
  const page = await open("report", 390);
  const table = page.locator("table", { has: page.locator("th", { hasText: "mean vertical wedge force, bolster going up" }) });
  const rows = table.locator("tbody tr:visible");
  const all = await table.locator("tbody tr").count();
  assert.ok(all > 12, `${all} rows`);
  assert.equal(await rows.count(), 12);
  const tools = page.locator(".rows").first();
  await tools.getByRole("button").click();
  assert.equal(await rows.count(), all);
  await tools.getByLabel("Filter rows").fill("LARGEST  vertical");
  assert.equal(await rows.count(), 1);
  assert.match(await tools.locator("output").textContent(), new RegExp(`^1 of ${all} rows$`));
  assert.equal(await rows.first().evaluate((row) => getComputedStyle(row).display), "block");
  const label = await rows.first().locator("td").nth(2).evaluate((cell) => getComputedStyle(cell, "::before").content);
  assert.match(label, /wedge/);
  await page.close();
});

/** Where the cross of axes points, by its letters. */
const cross = (run) =>
  run.locator(".wl-triad").evaluate((triad) =>
    Object.fromEntries([...triad.querySelectorAll("text")].map((text) => [text.textContent, [Number(text.getAttribute("x")), Number(text.getAttribute("y")) - 4].map((x) => Math.sign(Math.round(x / 5)) + 0)])),
  );

test("issue_036_the cross of axes follows named views at once, which are parallel along an axis", { skip }, async () => {
  const page = await open("truck");
  const run = page.locator(".wl-run");
  const looks = await page.evaluate(() => JSON.parse(document.getElementById("wedgelab-view").textContent).runs[0].scene.looks);
  let along = 0;
  for (const [k, { name, from }] of looks.entries()) {
    await run.getByLabel(`view: ${name} `).click();
    const seen = await cross(run);
    const flat = from.filter((part) => part !== 0).length === 1;
    assert.equal(await run.evaluate((element) => element.dataset.flat), String(flat), name);
    if (!flat) {
      assert.equal(Object.keys(seen).length, 3, name);
      continue;
    }
    along++;
    // Right, up and towards the eye make a right-handed system.
    const gaze = from.findIndex((part) => part !== 0);
    assert.ok(!("xyz"[gaze] in seen), `${name}: ${JSON.stringify(seen)}`);
    if (gaze !== 2) {
      assert.deepEqual(seen.z, [0, -1], name);
      const right = gaze === 0 ? ["y", Math.sign(from[0])] : ["x", -Math.sign(from[1])];
      assert.deepEqual(seen[right[0]], [right[1], 0], name);
    }
    // Equal lengths are equally long: wedges in front of each other are as far apart as those behind.
    const { pixels } = await run.evaluate((element) => ({ pixels: JSON.parse(element.dataset.pixels) }));
    const apart = (a, b) => Math.hypot(...[0, 1].map((n) => pixels[a][n] - pixels[b][n]));
    const [left, right] = ["left", "right"].map((side) => apart(`leading_${side}_wedge`, `trailing_${side}_wedge`));
    assert.ok(Math.abs(left - right) < 1.5, `${name}: ${left} and ${right} px`);
    assert.ok(k < 9);
  }
  assert.ok(along >= 2, `${along} views along an axis`);
  await page.close();
});

/** Saves what a click downloads. */
async function download(page, button) {
  const [file] = await Promise.all([page.waitForEvent("download"), button.click()]);
  return { name: file.suggestedFilename(), bytes: readFileSync(await file.path()) };
}

test("a loop stands beside the view, its point where the table says; curves and view are saved", { skip }, async () => {
  const page = await open("report");
  const run = page.locator('details[data-run="wedge"] .wl-run');
  const [head, ...lines] = readFileSync(join(folder, "wedge", "result.csv"), "utf8").trim().split("\n");
  const names = head.split(",");
  const rows = lines.map((line) => line.split(",").map(Number));
  const column = (name) => rows.map((row) => row[names.indexOf(name)]);
  const [time, travel, force] = ["time_s", "bolster_vertical_in", "vertical_wedge_force_lbf"].map(column);
  const most = Math.max(...force.map(Math.abs));
  for (const row of [100, 200]) {
    await run.locator(".wl-scrubber").evaluate((slider, to) => {
      slider.value = String(to);
      slider.dispatchEvent(new Event("input"));
    }, time[row]);
    const [[x, y]] = JSON.parse(await run.locator(".wl-loop").evaluate((loop) => loop.dataset.points));
    assert.ok(Math.abs(x - travel[row]) < 1e-3, `${x} is not ${travel[row]}`);
    assert.ok(Math.abs(y - force[row]) < 1e-4 * most + 0.1, `${y} is not ${force[row]}`);
  }
  // Another run beside it: in the plots and in what is saved.
  await run.getByLabel("run drawn beside this one").selectOption({ label: "beside: softer" });
  const table = await download(page, run.locator(".wl-loop .wl-save"));
  assert.match(table.name, /^wedge_Vertical_wedge_force_over_travel\.csv$/);
  const saved = String(table.bytes).trim().split("\n").map((line) => line.split(","));
  assert.deepEqual(saved[0], ["bolster_vertical (in)", "vertical_wedge_force (lbf)", "bolster_vertical of softer (in)", "vertical_wedge_force of softer (lbf)"]);
  assert.equal(saved.length - 1, rows.length);
  assert.ok(Math.abs(Number(saved[201][1]) - force[200]) < 1e-4 * most + 0.1);
  assert.ok(saved.slice(1).some(([, own, , other]) => Math.abs(own - other) > 0.05 * most), "the softer wedge differs");
  const picture = await download(page, run.getByLabel("save this view as a picture"));
  assert.match(picture.name, /^wedge_at_2\.00_s\.png$/);
  assert.ok(picture.bytes.length > 5000 && picture.bytes.subarray(1, 4).toString() === "PNG", `${picture.bytes.length} bytes`);
  // Bodies are named, and the names can be taken away.
  assert.ok((await run.locator(".wl-names span").allTextContents()).some((name) => /wedge/i.test(name)));
  await run.getByLabel("names of the bodies").click();
  assert.equal(await run.locator(".wl-names span:visible").count(), 0);
  assert.deepEqual(faults, []);
  await page.close();
});
