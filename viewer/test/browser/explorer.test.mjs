// The explorer in a real browser. WEDGELAB: the program; WEDGELAB_CHROMIUM: the browser.
import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { request } from "node:http";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { after, before, test } from "node:test";
import { chromium } from "playwright-core";
import { faint, tooWide, WIDTHS } from "./seen.mjs";

const program = process.env.WEDGELAB;
const skip = program ? false : "WEDGELAB names the program";

/** Yawed, toe in: the slowest of the thesis's runs. */
const CASE = "vdrun_toe_in_0.2_psi_0.012";
const JOULES = 0.1129848290276167;

let browser;
let server;
/** With its token. */
let address;
let origin;
let folder;
let ended;
let faults = [];

before(async () => {
  if (skip) {
    return;
  }
  folder = mkdtempSync(join(tmpdir(), "wedgelab-explorer-"));
  server = spawn(program, ["explore", CASE], { cwd: folder, stdio: ["ignore", "pipe", "inherit"] });
  ended = new Promise((resolve) => server.once("exit", (code, signal) => resolve({ code, signal })));
  const [line] = await new Promise((resolve) => createInterface(server.stdout).once("line", (text) => resolve([text])));
  address = /http:\/\/[^ ]+/.exec(line)[0];
  origin = new URL(address).origin;
  browser = await chromium.launch({
    executablePath: process.env.WEDGELAB_CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
      "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"],
  });
});

after(async () => {
  await browser?.close();
  server?.kill("SIGKILL");
  if (folder) {
    rmSync(folder, { recursive: true, force: true });
  }
});

/** A page on which every complaint, and every look elsewhere, is noted. */
async function open(size = { width: 1280, height: 900 }, options = {}) {
  faults = [];
  const page = await browser.newPage({ viewport: size, ...options });
  page.on("pageerror", (error) => faults.push(String(error)));
  page.on("console", (message) => {
    // Refused values are answered with 422 and replaced runs with 409, which the browser tells as errors; drivers in software say so.
    if (["error", "warning"].includes(message.type()) && !/GPU stall due to ReadPixels|status of (422|409)/.test(message.text())) {
      faults.push(message.text());
    }
  });
  const foreign = (url) => !/^(data|blob):/.test(url) && !url.startsWith(`${origin}/`);
  page.on("request", (own) => foreign(own.url()) && faults.push(own.url()));
  await page.goto(address);
  await page.waitForSelector("#explorer[data-explorer=ready]", { timeout: 30_000 });
  return page;
}

const state = (page) => page.evaluate(() => ({ ...document.querySelector("#explorer").dataset, ...document.querySelector(".wx-loops").dataset }));

/** Does something, and waits until it has been run. */
async function after_run(page, act) {
  const { runs } = await state(page);
  await act();
  await page.waitForFunction(
    (before) => {
      const { runs: now, running } = document.querySelector("#explorer").dataset;
      return Number(now) > before && !running;
    },
    Number(runs),
    { timeout: 30_000 },
  );
  return state(page);
}

/** Runs the case with `wedgelab run`; gives the folder of its files. */
function ran(...set) {
  const out = join(folder, "run");
  const done = spawnSync(program, ["run", CASE, "--quiet", "--force", "--out", out, ...set.flatMap((own) => ["--set", own])], { encoding: "utf8" });
  assert.equal(done.status, 0, done.stderr);
  return out;
}

/** The last value of a column, by `wedgelab run`. */
function last(column, ...set) {
  const lines = readFileSync(join(ran(...set), "result.csv"), "utf8").trim().split("\n");
  return Number(lines.at(-1).split(",")[lines[0].split(",").indexOf(column)]);
}

/** J a cycle at the side frame, by `wedgelab run`. */
function told(...set) {
  const out = ran(...set);
  const { value, unit } = JSON.parse(readFileSync(join(out, "summary.json"), "utf8")).averages.energy_per_cycle.side_frame;
  assert.equal(unit, "lbf·in");
  return value * JOULES;
}

const same = (energy, wanted) => assert.ok(Math.abs(Number(energy) - wanted) <= 1e-12 * wanted, `${energy} is not ${wanted}`);

const field = (page, path) => page.locator(`.wx-field[data-path="${path}"]`);

const type = (page, path, text) => async () => {
  const input = field(page, path).locator("input[type=text]").first();
  await input.fill(text);
  await input.press("Enter");
};

test("it begins with the case's loop, its plots and its 3D view, without complaints", { skip }, async () => {
  const page = await open();
  const now = await state(page);
  same(now.energy, told());
  assert.equal(now.loops, "1");
  await page.locator(".wl-run[data-ready]").waitFor({ timeout: 20_000 });
  assert.equal(await page.locator(".wl-plot, .wl-loop").count(), 3);
  assert.equal(await page.locator("#preset").inputValue(), CASE);
  await page.waitForTimeout(500);
  assert.deepEqual(faults, []);
  await page.close();
});

test("issue 29: only the address with its token opens the page, also again", { skip }, async () => {
  const token = new URL(address).searchParams.get("token");
  assert.match(token, /^[0-9a-f]{64}$/);
  const page = await open();
  const seen = [];
  page.on("request", (own) => seen.push({ url: own.url(), headers: own.headers() }));
  await page.reload();
  await page.waitForSelector("#explorer[data-explorer=ready]", { timeout: 30_000 });
  await after_run(page, type(page, "friction.column", "0.3"));
  const api = seen.filter(({ url }) => url.startsWith(`${origin}/api/`));
  assert.ok(api.length >= 3, `${api.length} requests`);
  for (const { url, headers } of seen) {
    assert.equal(url.includes(token), url === address, url);
    assert.ok(!(headers.referer ?? "").includes(token), `${url} tells where it comes from`);
    const asks = api.some((own) => own.url === url);
    assert.equal(headers.authorization, asks ? `Bearer ${token}` : undefined, url);
  }
  assert.deepEqual(await page.context().cookies(), []);
  assert.ok(!(await page.content()).includes(token));
  assert.deepEqual(faults, []);
  for (const wrong of [`${origin}/`, `${origin}/?token=${token.slice(1)}0`]) {
    const answer = await page.goto(wrong);
    assert.equal(answer.status(), 403);
    assert.match(await page.textContent("body"), /open the address that `wedgelab explore` printed/);
  }
  await page.close();
});

test("a truck is a click away, with its own loop and the whole truck in 3D", { skip }, async () => {
  const page = await open();
  const truck = await after_run(page, () => page.locator("#preset").selectOption("truck_warp_nest_constant_rising"));
  assert.equal(truck.loops, "1");
  assert.match(await page.locator(".wx-loops").textContent(), /Energy lost at the four wedges/);
  assert.ok(Number(truck.energy) > 1000, truck.energy);
  await page.locator(".wl-run[data-ready]").waitFor({ timeout: 20_000 });
  const again = await after_run(page, () => page.locator("#preset").selectOption(CASE));
  assert.equal(again.loops, "1");
  assert.deepEqual(faults, []);
  await page.close();
});

test("a slider and a typed value give new loops, with the energies of the command line", { skip }, async (t) => {
  const page = await open();
  const slider = field(page, "friction.column").locator("input[type=range]");
  const slid = await after_run(page, () =>
    slider.evaluate((own) => {
      own.value = "60";
      own.dispatchEvent(new Event("input"));
      own.dispatchEvent(new Event("change"));
    }),
  );
  const text = await field(page, "friction.column").locator("input[type=text]").inputValue();
  assert.equal(text, "0.3");
  same(slid.energy, told("friction.column=0.3"));
  assert.equal(slid.loops, "2");
  t.diagnostic(`shown after ${slid.milliseconds} ms`);
  // By key: one step of 200.
  await slider.focus();
  const stepped = await after_run(page, () => page.keyboard.press("ArrowRight"));
  same(stepped.energy, told("friction.column=0.305"));
  const typed = await after_run(page, type(page, "friction.column", "0.35"));
  same(typed.energy, told("friction.column=0.35"));
  assert.equal(await slider.inputValue(), "70");
  const both = await after_run(page, type(page, "side_frame.toe", "0.1 deg out"));
  same(both.energy, told("friction.column=0.35", "side_frame.toe=0.1 deg out"));
  assert.equal(await page.locator(".wx-loops tbody tr").count(), Number(both.loops));
  const back = await after_run(page, () => field(page, "friction.column").locator(".wx-reset").click());
  same(back.energy, told("side_frame.toe=0.1 deg out"));
  assert.equal(await field(page, "friction.column").locator("input[type=text]").inputValue(), "0.4");
  assert.deepEqual(faults, []);
  await page.close();
});

test("while a slider moves the loop follows; one loop is left of it, that of its last place", { skip }, async () => {
  const page = await open();
  await field(page, "friction.slope").locator("input[type=range]").evaluate(async (own) => {
    for (let place = 80; place >= 50; place--) {
      own.value = String(place);
      own.dispatchEvent(new Event("input"));
      await new Promise((resolve) => window.setTimeout(resolve, 30));
    }
    own.dispatchEvent(new Event("change"));
  });
  await page.waitForFunction(() => !document.querySelector("#explorer").dataset.running);
  const now = await state(page);
  assert.ok(Number(now.runs) > 2, `${now.runs} runs: it follows`);
  assert.equal(now.loops, "2");
  same(now.energy, told("friction.slope=0.25"));
  // The next change does not take its place.
  const next = await after_run(page, type(page, "friction.slope", "0.3"));
  assert.equal(next.loops, "3");
  assert.deepEqual(faults, []);
  await page.close();
});

test("issue 7: an answer that comes while a slider moves on leaves the slider where it is", { skip }, async () => {
  const page = await open();
  const own = field(page, "friction.slope");
  const slider = own.locator("input[type=range]");
  const text = own.locator("input[type=text]");
  const move = (place, event) =>
    slider.evaluate(
      (input, [to, name]) => {
        input.value = to ?? input.value;
        input.dispatchEvent(new Event(name));
      },
      [place, event],
    );
  // The first answer is held back until the slider has moved on.
  let answered;
  const held = new Promise((resolve) => (answered = resolve));
  let let_go;
  const gate = new Promise((resolve) => (let_go = resolve));
  await page.route(
    "**/api/run",
    async (route) => {
      const response = await route.fetch();
      answered();
      await gate;
      await route.fulfill({ response });
    },
    { times: 1 },
  );
  const { runs } = await state(page);
  await move("60", "input");
  await held;
  await move("50", "input");
  let_go();
  await page.waitForFunction((before) => Number(document.querySelector("#explorer").dataset.runs) > before, Number(runs));
  assert.deepEqual([await slider.inputValue(), await text.inputValue()], ["50", "0.25"]);
  await move(undefined, "change");
  await page.waitForFunction(() => !document.querySelector("#explorer").dataset.running);
  same((await state(page)).energy, told("friction.slope=0.25"));
  await page.close();
});

test("no more than eight loops, the latest on top", { skip }, async () => {
  const page = await open();
  for (let k = 1; k <= 9; k++) {
    await after_run(page, type(page, "friction.slope", `0.${30 + k}`));
  }
  const now = await state(page);
  assert.equal(now.loops, "8");
  assert.match(await page.locator(".wx-loops tbody tr").first().textContent(), /friction\.slope = 0\.39/);
  same(now.energy, told("friction.slope=0.39"));
  await page.close();
});

test("a face with more points than its corners is coloured by its pressure", { skip }, async () => {
  const page = await open();
  await page.locator(".wl-run[data-ready]").waitFor({ timeout: 20_000 });
  const shown = () => page.evaluate(() => JSON.parse(document.querySelector(".wl-run").dataset.pressures));
  assert.deepEqual(await shown(), {});
  assert.equal(await page.locator(".wl-ramp").count(), 0);
  await after_run(page, async () => {
    const area = field(page, "column_face.grid").locator("textarea");
    await area.evaluate((own) => {
      own.closest("details").open = true;
    });
    await area.fill("[5, 4]");
    await area.blur();
  });
  await page.locator(".wl-run[data-ready] .wl-ramp").waitFor({ timeout: 20_000 });
  // The bolster is deepest then, and the wedge pressed most.
  await page.locator(".wl-run input[type=range]").first().evaluate((own) => {
    own.value = "2.36";
    own.dispatchEvent(new Event("input"));
  });
  const { column, ...others } = await shown();
  assert.deepEqual(others, {});
  const lines = readFileSync(join(ran("column_face.grid=[5, 4]"), "result.csv"), "utf8").trim().split("\n");
  const pressures = lines[0].split(",").flatMap((name, at) => (/^column_point_\d_\d_pressure_psi$/.test(name) ? [at] : []));
  assert.equal(pressures.length, 20);
  const { time } = await page.evaluate(() => document.querySelector(".wl-run").dataset);
  const values = lines.map((line) => line.split(",").map(Number)).find(([own]) => Math.abs(own - Number(time)) < 1e-9);
  const greatest = Math.max(...pressures.map((at) => values[at])) * 6894.757293168362;
  assert.ok(greatest > 0 && Math.abs(column - greatest) < 1e-4 * greatest, `${column} is not ${greatest}`);
  assert.match(await page.locator(".wl-run").textContent(), /pressure: 0\s+[\d,.]+ psi and more/);
  assert.deepEqual(faults, []);
  await page.close();
});

test("a bad value is explained where it was typed, and put right there", { skip }, async () => {
  const page = await open();
  const before = await state(page);
  const own = field(page, "friction.column");
  await type(page, "friction.column", "-1")();
  await own.locator(".wx-mistake").filter({ hasText: "between 0 and 10" }).waitFor();
  assert.equal(await own.locator("input[type=text]").getAttribute("aria-invalid"), "true");
  assert.equal(await page.locator(".wx-mistake:visible").count(), 1);
  // In a section that is folded.
  await page.locator(".wx-section > summary", { hasText: "Wedge" }).click();
  await type(page, "wedge.angle", "32 in")();
  await field(page, "wedge.angle").locator(".wx-mistake").filter({ hasText: "angle" }).waitFor();
  assert.equal(await page.locator(".wx-mistake:visible").count(), 2);
  assert.equal((await state(page)).runs, before.runs, "nothing was run");
  // The bar names both, and what else is changed runs with the last good values.
  const bar = page.locator(".wx-bar");
  assert.match(await bar.textContent(), /friction\.column = -1: .*Runs go on with the case's own value/s);
  assert.match(await bar.textContent(), /wedge\.angle = 32 in/);
  const others = await after_run(page, type(page, "friction.slope", "0.35"));
  same(others.energy, told("friction.slope=0.35"));
  assert.equal(await page.locator(".wx-mistake:visible").count(), 2, "what was typed wrongly stays");
  await after_run(page, () => field(page, "friction.slope").locator(".wx-reset").click());
  await after_run(page, type(page, "friction.column", "0.3"));
  const right = await after_run(page, type(page, "wedge.angle", "33 deg"));
  same(right.energy, told("friction.column=0.3", "wedge.angle=33 deg"));
  assert.equal(await page.locator(".wx-mistake:visible").count(), 0);
  assert.equal(await bar.locator("p").count(), 0);
  assert.deepEqual(faults, []);
  await page.close();
});

test("units switch, by button and by key; what was typed is rewritten, the case is not changed", { skip }, async () => {
  const page = await open();
  await page.locator(".wl-run[data-ready]").waitFor({ timeout: 20_000 });
  const energy = page.locator(".wx-loops tbody tr").first().locator("td").nth(1);
  const pounds = Number(await energy.textContent());
  await page.locator(".wx-section > summary", { hasText: "Control coil" }).click();
  await page.locator(".wx-section > summary", { hasText: "Wedge" }).click();
  const text = (path) => field(page, path).locator("input[type=text], textarea").first().inputValue();
  assert.equal(await text("wedge.height"), "6.125 in");
  const place = await field(page, "wedge.height").locator("input[type=range]").inputValue();
  await page.locator(".wl-units").click();
  const switched = await state(page);
  assert.equal(switched.units, "si");
  assert.match(await page.locator(".wx-loops thead").textContent(), /\(J\)/);
  assert.ok(Math.abs(Number(await energy.textContent()) - pounds * JOULES) < 0.06);
  assert.match(await page.locator(".wl-key").textContent(), / N/);
  assert.equal(await text("wedge.height"), "0.155575 m");
  assert.equal(await text("wedge.angle"), "32 deg");
  assert.match(await text("control_coil.stiffness"), /^525380\.505\d+ N\/m$/);
  assert.match(await text("bolster.vertical"), /amplitude = "0\.0254 m", frequency = "2 rad\/s"/);
  assert.equal(await text("bolster.vertical.amplitude"), "0.0254 m");
  assert.equal(await field(page, "wedge.height").locator("input[type=range]").inputValue(), place, "the slider stays");
  assert.equal(switched.runs, "1", "nothing was run");
  // What is typed now is sent as it stands, and shown in the other units after.
  const typed = await after_run(page, type(page, "wedge.height", "0.16 m"));
  same(typed.energy, told("wedge.height=0.16 m"));
  // One number of three: the others are sent as the case has them.
  const inertia = field(page, "wedge.inertia").locator("input[type=text]");
  assert.match(await inertia.nth(0).inputValue(), / kg m\^2$/);
  await inertia.nth(1).fill("0.05 kg m^2");
  const third = await after_run(page, () => inertia.nth(1).press("Enter"));
  same(third.energy, told("wedge.height=0.16 m", 'wedge.inertia=["100 lb in^2", "0.05 kg m^2", "100 lb in^2"]'));
  await page.keyboard.press("Alt+u");
  assert.equal((await state(page)).units, "us");
  assert.equal(await text("control_coil.stiffness"), "3000 lbf/in");
  assert.match(await text("wedge.height"), /^6\.2992125984\d* in$/);
  const slid = await after_run(page, () => field(page, "wedge.height").locator("input[type=range]").press("ArrowRight"));
  assert.match(await text("wedge.height"), / in$/);
  assert.equal(slid.loops, "4");
  assert.deepEqual(faults, []);
  await page.close();
});

test("each part of a sum, and each point of a table, has a slider that changes the loop", { skip }, async () => {
  const page = await open();
  const sum = '[{ shape = "sine", amplitude = "1 in", frequency = "2 rad/s" }, { shape = "sine", amplitude = "0.1 in", frequency = "9 rad/s" }]';
  const area = field(page, "bolster.vertical").locator("textarea");
  await page.locator(".wl-run[data-ready]").waitFor({ timeout: 20_000 });
  await page.locator(".wl-run").evaluate((own) => (own.dataset.old = "yes"));
  await after_run(page, async () => {
    await area.fill(sum);
    await area.blur();
  });
  const first = field(page, "bolster.vertical.0.amplitude").locator("input[type=range]");
  const slide = (slider, to) => () =>
    slider.evaluate((own, value) => {
      own.value = value;
      own.dispatchEvent(new Event("input"));
      own.dispatchEvent(new Event("change"));
    }, to);
  // Sums have no cycles, and no energy of one: the last force is compared.
  const run = page.locator(".wl-run[data-ready]:not([data-old])");
  const agrees = async (...set) => {
    await run.waitFor({ timeout: 20_000 });
    await run.focus();
    await page.keyboard.press("End");
    const shown = await run.locator('output[data-column="longitudinal_wedge_force"]').textContent();
    const value = Number(shown.replace("\u2212", "-").replace(" lbf", ""));
    const wanted = last("longitudinal_wedge_force_lbf", ...set);
    assert.ok(Math.abs(value - wanted) <= 5e-4 * Math.abs(wanted) + 1e-3, `${shown} is not ${wanted}`);
    await run.evaluate((own) => (own.dataset.old = "yes"));
  };
  await agrees(`bolster.vertical=${sum}`);
  await after_run(page, slide(first, "180"));
  const text = await field(page, "bolster.vertical.0.amplitude").locator("input[type=text]").inputValue();
  assert.equal(text, "1.6 in");
  await agrees(`bolster.vertical=${sum}`, `bolster.vertical.0.amplitude=${text}`);
  await after_run(page, type(page, "bolster.vertical.1.frequency", "7 rad/s"));
  await agrees(`bolster.vertical=${sum}`, `bolster.vertical.0.amplitude=${text}`, "bolster.vertical.1.frequency=7 rad/s");
  assert.match(await area.inputValue(), /1\.6 in[^]*7 rad\/s/, "the whole text follows");
  // What is wrong is said at the part.
  await type(page, "bolster.vertical.1.frequency", "7 in")();
  await field(page, "bolster.vertical.1.frequency").locator(".wx-mistake").filter({ hasText: "frequency" }).waitFor();
  const table = '{ shape = "table", points = [["0 s", "0 in"], ["3 s", "1 in"], ["6 s", "-1 in"], ["10 s", "0 in"]] }';
  await after_run(page, async () => {
    await area.fill(table);
    await area.blur();
  });
  await run.waitFor({ timeout: 20_000 });
  await run.evaluate((own) => (own.dataset.old = "yes"));
  await after_run(page, type(page, "bolster.vertical.points.1.1", "1.5 in"));
  await agrees(`bolster.vertical=${table}`, "bolster.vertical.points.1.1=1.5 in");
  await page.close();
});

test("after a change camera, exaggeration, arrows, plots, time and speed are as they were left", { skip }, async () => {
  const page = await open();
  const run = page.locator(".wl-run[data-ready]");
  await run.waitFor({ timeout: 20_000 });
  await run.focus();
  for (const key of ["3", "a", "a", "w", "e", "-"]) {
    await page.keyboard.press(key);
  }
  await run.getByLabel("length of arrows").selectOption("2");
  await run.locator(".wl-scrubber").evaluate((slider) => {
    slider.value = "3.21";
    slider.dispatchEvent(new Event("input"));
  });
  await run.locator(".wl-choice").nth(1).selectOption({ label: "Coil force" });
  await run.locator("button.wl-entry").first().click();
  const seen = () =>
    run.evaluate((own) => ({
      eye: own.dataset.eye,
      factor: own.dataset.factor,
      time: own.dataset.time,
      speed: own.querySelector('[aria-label="speed"]').value,
      arrows: own.querySelector('[aria-label="length of arrows"]').value,
      plots: [...own.querySelectorAll(".wl-choice")].map((list) => list.selectedOptions[0].text),
      hidden: [...own.querySelectorAll('.wl-entry[aria-pressed="false"]')].map((entry) => entry.textContent.split(":")[0]),
    }));
  const before = await seen();
  await run.evaluate((own) => (own.dataset.old = "yes"));
  await after_run(page, type(page, "friction.column", "0.3"));
  await page.locator(".wl-run[data-ready]:not([data-old])").waitFor({ timeout: 20_000 });
  assert.deepEqual(await seen(), before);
  assert.equal(before.factor, "20");
  assert.equal(before.hidden.length, 1);
  assert.deepEqual(faults, []);
  await page.close();
});

test("every control has a name and can be reached by keys", { skip }, async () => {
  const page = await open();
  await page.locator(".wx-section").evaluateAll((folds) => folds.forEach((fold) => (fold.open = true)));
  const nameless = await page.locator(".wx-controls :is(input, select, textarea, button)").evaluateAll((all) =>
    all
      .filter((own) => !own.labels?.length && !own.getAttribute("aria-label") && !own.textContent.trim())
      .map((own) => own.outerHTML),
  );
  assert.deepEqual(nameless, []);
  await page.locator("#preset").focus();
  const seen = new Set();
  for (let k = 0; k < 40; k++) {
    await page.keyboard.press("Tab");
    seen.add(await page.evaluate(() => document.activeElement.closest(".wx-field")?.dataset.path ?? ""));
  }
  assert.ok(seen.has("name") && seen.has("wedge.angle") && seen.has("wedge.inertia"), [...seen].join(" "));
  await page.close();
});

test("a preset brings its values; files are kept", { skip }, async () => {
  const page = await open();
  await after_run(page, type(page, "friction.column", "0.2"));
  const [kept] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "case.toml" }).click()]);
  assert.equal(kept.suggestedFilename(), `${CASE}_case.toml`);
  assert.match(readFileSync(await kept.path(), "utf8"), /^column = 0\.2 /m);
  const [table] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "result.csv" }).click()]);
  assert.match(readFileSync(await table.path(), "utf8"), /^time_s,/);
  await after_run(page, () => page.locator("#preset").selectOption("cdrun_toe_0_psi_0"));
  assert.equal(await field(page, "friction.column").locator("input[type=text]").inputValue(), "0.4");
  assert.equal(await field(page, "wedge.damping").locator("select").inputValue(), "constant");
  assert.deepEqual(faults, []);
  await page.close();
});

test("issue_036_nothing of the explorer sticks out at any width, and it can be read on light and on dark paper", { skip }, async () => {
  const page = await open({ width: 1366, height: 800 });
  await page.locator(".wl-run[data-ready]").waitFor({ timeout: 20_000 });
  await page.locator(".wx-section").evaluateAll((folds) => folds.forEach((fold) => (fold.open = true)));
  await type(page, "friction.column", "-1")();
  await page.locator(".wx-bar p").waitFor();
  for (const colorScheme of ["light", "dark"]) {
    await page.emulateMedia({ colorScheme });
    for (const width of WIDTHS) {
      await page.setViewportSize({ width, height: 800 });
      assert.deepEqual(await tooWide(page), [], `${width} px, ${colorScheme}`);
    }
    const { texts, found } = await faint(page);
    assert.ok(texts > 100, `${texts} texts`);
    assert.deepEqual(found, [], colorScheme);
    const paper = await page.evaluate(() => window.getComputedStyle(document.body).backgroundColor);
    assert.equal(paper, colorScheme === "dark" ? "rgb(20, 24, 28)" : "rgb(255, 255, 255)");
    if (process.env.WEDGELAB_PICTURES) {
      await page.screenshot({ path: join(process.env.WEDGELAB_PICTURES, `explorer-${colorScheme}.png`) });
    }
  }
  await page.close();
});

/** The status of a request with headers of one's own. */
function status(headers, path = "/api/case") {
  const { hostname, port } = new URL(address);
  return new Promise((resolve, reject) => {
    const asked = request({ hostname, port, path, headers, setHost: false }, (answer) => {
      answer.resume();
      resolve(answer.statusCode);
    });
    asked.once("error", reject);
    asked.end();
  });
}

test("foreign pages and foreign names are refused", { skip }, async () => {
  const { host, searchParams } = new URL(address);
  const Authorization = `Bearer ${searchParams.get("token")}`;
  assert.equal(await status({ Host: host, Authorization }), 200);
  assert.equal(await status({ Host: host }), 403);
  assert.equal(await status({ Host: host, Authorization, Origin: "http://evil.example" }), 403);
  assert.equal(await status({ Host: `evil.example:${host.split(":")[1]}`, Authorization }), 403);
  // A page elsewhere cannot read it, nor run anything.
  const page = await browser.newPage();
  await page.goto("about:blank");
  const read = await page.evaluate(
    (from) => window.fetch(`${from}/api/run`, { method: "POST", mode: "no-cors", body: "{}" }).then((answer) => answer.type, () => "refused"),
    origin,
  );
  assert.ok(["opaque", "refused"].includes(read), read);
  await page.close();
});

// How long it takes depends on the machine, and is only told; what makes it long is counted.
test("a change of a yawed case is computed once and seen", { skip }, async (t) => {
  const page = await open();
  await page.locator(".wl-run[data-ready]").waitFor({ timeout: 20_000 });
  const times = [];
  for (let k = 0; k < 7; k++) {
    const before = Number((await state(page)).runs);
    const { milliseconds } = await after_run(page, type(page, "friction.column", `0.4${k + 1}`));
    times.push(Number(milliseconds));
    await page.waitForTimeout(1500);
    assert.equal(Number((await state(page)).runs), before + 1);
  }
  times.sort((a, b) => a - b);
  t.diagnostic(`from the change to the new loop: ${times.join(", ")} ms`);
  await page.close();
});

test("it stops cleanly", { skip }, async () => {
  const page = await open();
  server.kill("SIGINT");
  assert.deepEqual(await ended, { code: 0, signal: null });
  await type(page, "friction.column", "0.3")();
  await page.locator(".wx-faults").filter({ hasText: "does not answer" }).waitFor();
  await page.close();
});
