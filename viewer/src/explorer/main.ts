// The explorer: every value of a case, and what becomes of its loop.

import "uplot/dist/uPlot.min.css";
import "../style.css";
import "./explorer.css";

import type { Quantity, System, ViewDocument } from "../contract.js";
import { Data } from "../data.js";
import { element } from "../dom.js";
import { RunView } from "../run.js";
import { Store } from "../store.js";
import { Units } from "../units.js";
import { keep, opening, run, why, type Answer, type Mistake, type Opening, type Outcome, type Wanted } from "./api.js";
import { Form } from "./form.js";
import { loopOf, Loops } from "./loops.js";

/** A run that takes longer than this is not waited for when something else was changed, ms. */
const PATIENCE = 600;
/** The 3D view follows when nothing has changed for so long, ms. */
const REST = 350;
const FILES = ["case.toml", "result.csv", "result.mat", "summary.json"];

/** What is set of a field, or inside it. */
function within(set: Record<string, string>, path: string): string {
  return JSON.stringify(Object.entries(set).filter(([own]) => own === path || own.startsWith(`${path}.`)));
}

/** What was typed wrongly: while it stands in its field, the last good value runs. */
interface Wrong {
  text: string;
  mistakes: Mistake[];
}

class Explorer {
  private readonly form: Form;
  private readonly loops: Loops;
  private readonly units: Store<Units>;
  private readonly systems: Record<System, Units>;
  private readonly status = element("p", { class: "wx-status", role: "status" });
  private readonly faults = element("div", { class: "wx-faults", role: "alert" });
  private readonly bar = element("div", { class: "wx-bar", role: "alert" });
  private readonly lookAt = element("p", { class: "wx-about" });
  private readonly stage = element("div", { class: "wx-stage" });
  private preset: string | null;
  private set: Record<string, string> = {};
  /** What was set in the last run that was made. */
  private good: Record<string, string> = {};
  private wrong = new Map<string, Wrong>();
  /** What is being asked for, and since when. */
  private asked: { since: number } | undefined;
  private waiting: { live: boolean; first: boolean } | undefined;
  private number = 0;
  private last = "";
  private label = "";
  private view: RunView | undefined;
  private timer = 0;

  constructor(
    private readonly start: Opening,
    first: Answer,
    private readonly root: HTMLElement,
  ) {
    this.preset = start.preset;
    const quantities: Record<string, Quantity> = first.view.quantities;
    this.systems = { us: new Units(quantities, "us"), si: new Units(quantities, "si") };
    this.units = new Store(this.systems[first.view.units]);
    this.form = new Form(
      this.units,
      (path, text, live) => this.change(path, text, live),
      (path) => this.back(path),
    );
    this.loops = new Loops(quantities, this.units);
    this.build();
    this.take(first, this.wanted(), { live: false, first: true });
  }

  private wanted(): Wanted {
    return { preset: this.preset, set: { ...this.set } };
  }

  private build(): void {
    const { start } = this;
    const presets = element("select", { id: "preset" });
    if (start.preset === null) {
      presets.append(element("option", { value: "" }, `${start.name} (your file)`));
    }
    for (const group of start.presets) {
      presets.append(
        element(
          "optgroup",
          { label: group.title },
          ...group.cases.map(({ name, title }) => element("option", { value: name, title }, name)),
        ),
      );
    }
    presets.value = start.preset ?? "";
    presets.addEventListener("change", () => {
      this.preset = presets.value || null;
      this.set = {};
      this.forgive();
      this.label = presets.value || start.name;
      this.about();
      this.ask({ live: false, first: true });
    });
    this.label = start.name;
    const button = (text: string, act: () => void, attributes: Record<string, string> = {}): HTMLButtonElement =>
      element("button", { type: "button", ...attributes, onclick: act }, text);
    const units = button("", () => this.switchUnits(), { class: "wl-units" });
    this.units.watch(({ system }) => {
      units.textContent = system === "us" ? "Units: inch-pound" : "Units: SI";
      units.title = `show ${system === "us" ? "SI" : "inch-pound"} units in fields, plots and 3D view; the case stays as it is (Alt+U)`;
      this.root.dataset.units = system;
    });
    document.addEventListener("keydown", (event) => {
      if (event.altKey && event.code === "KeyU") {
        event.preventDefault();
        this.switchUnits();
      }
    });
    const exports = FILES.map((file) => button(file, () => void this.keep(file)));
    this.about();
    this.root.replaceChildren(
      element("header", { class: "wx-header" }, element("h1", {}, "Wedgelab explorer"), units, this.status),
      this.bar,
      element(
        "div",
        { class: "wx-page" },
        element(
          "div",
          { class: "wx-controls" },
          element("div", { class: "wx-preset" }, element("label", { for: "preset" }, "Case"), presets, button("all back", () => this.allBack(), { title: "back to the case's values" })),
          this.lookAt,
          this.faults,
          this.form.root,
        ),
        element(
          "div",
          { class: "wx-results" },
          this.loops.root,
          element("div", { class: "wx-exports" }, button("forget earlier loops", () => this.loops.clear()), element("span", {}, "Save:"), ...exports),
          this.stage,
        ),
      ),
    );
  }

  private about(): void {
    const group = this.start.presets.find(({ cases }) => cases.some(({ name }) => name === this.preset));
    this.lookAt.textContent = group?.look_at ?? "";
  }

  private switchUnits(): void {
    this.units.set(this.units.value === this.systems.us ? this.systems.si : this.systems.us);
  }

  private change(path: string, text: string, live: boolean): void {
    // A motion that is typed anew replaces what was set inside it.
    const inside = Object.keys(this.set).filter((own) => own.startsWith(`${path}.`));
    const kept = Object.entries(this.set).filter(([own]) => !inside.includes(own));
    this.set = { ...Object.fromEntries(kept), [path]: text };
    this.forgive(path);
    this.label = `${path} = ${text}`;
    this.form.mark(path, true);
    this.ask({ live, first: false });
  }

  private back(path: string): void {
    this.set = Object.fromEntries(Object.entries(this.set).filter(([own]) => own !== path && !own.startsWith(`${path}.`)));
    this.forgive(path);
    this.label = `${path} back`;
    this.ask({ live: false, first: false });
  }

  private allBack(): void {
    this.set = {};
    this.forgive();
    this.label = this.preset ?? this.start.name;
    this.ask({ live: false, first: true });
  }

  /** Runs what is wanted now; while a quick run is under way, after it. */
  private ask(how: { live: boolean; first: boolean }): void {
    this.waiting = { live: how.live, first: how.first || (this.waiting?.first ?? false) };
    const { asked } = this;
    if (asked && performance.now() - asked.since < PATIENCE) {
      window.setTimeout(() => this.waiting && this.asked === asked && this.ask(this.waiting), PATIENCE);
      return;
    }
    void this.send();
  }

  private async send(): Promise<void> {
    const how = this.waiting;
    if (!how) {
      return;
    }
    this.waiting = undefined;
    const wanted = this.wanted();
    const text = JSON.stringify(wanted);
    if (!this.asked && text === this.last) {
      if (!how.live) {
        this.loops.settle();
      }
      delete this.root.dataset.running;
      return;
    }
    const asked = { since: performance.now() };
    this.asked = asked;
    this.root.dataset.running = "yes";
    this.status.textContent = "Running …";
    const outcome = await run(wanted);
    if (this.isLatest(asked)) {
      this.asked = undefined;
      this.tell(outcome, wanted, how, performance.now() - asked.since);
      delete this.root.dataset.running;
      void this.send();
    }
  }

  /** Whether no later request took its place. */
  private isLatest(asked: { since: number }): boolean {
    return this.asked === asked;
  }

  private tell(outcome: Outcome, wanted: Wanted, how: { live: boolean; first: boolean }, milliseconds: number): void {
    switch (outcome.is) {
      case "answer":
        this.take(outcome.answer, wanted, how);
        this.status.textContent = `${outcome.answer.summary.name}: shown after ${milliseconds.toFixed(0)} ms.`;
        this.root.dataset.milliseconds = milliseconds.toFixed(0);
        break;
      case "mistakes":
        this.refuse(outcome.mistakes, wanted, how);
        break;
      case "replaced":
        this.last = "";
        this.status.textContent = "Replaced by a run of another window.";
        break;
      case "failed":
        this.last = "";
        this.status.textContent = "Not run.";
        this.show([{ path: "", message: outcome.why, help: "" }]);
        break;
    }
  }

  /** What was changed since the last run is wrong: its last good value runs on, while what was typed stays in its field. */
  private refuse(mistakes: Mistake[], wanted: Wanted, how: { live: boolean; first: boolean }): void {
    this.last = "";
    const changed = [...new Set([...Object.keys(wanted.set), ...Object.keys(this.good)])].filter((path) => wanted.set[path] !== this.good[path]);
    const named = changed.filter((path) => mistakes.some((mistake) => mistake.path === path));
    // A mistake may be told at another field than the one that was changed: then all that was changed is to blame.
    for (const path of named.length > 0 ? named : changed) {
      const own = mistakes.filter((mistake) => named.length === 0 || mistake.path === path);
      this.wrong.set(path, { text: wanted.set[path] ?? "", mistakes: own });
      if (this.set[path] === wanted.set[path]) {
        const { [path]: before } = this.good;
        const others = Object.fromEntries(Object.entries(this.set).filter(([own]) => own !== path));
        this.set = before === undefined ? others : { ...others, [path]: before };
      }
    }
    const rest = changed.length > 0 ? this.complain() : this.form.complain(mistakes);
    this.show(rest);
    this.status.textContent = "Not run: something that was typed is wrong.";
    // What else was changed goes on with the last good value.
    if (changed.length > 0 && JSON.stringify(this.set) !== JSON.stringify(this.good)) {
      this.waiting ??= { live: how.live, first: how.first };
    }
  }

  /** Shows what is wrong in its fields and in the bar; gives what belongs to no field. */
  private complain(): Mistake[] {
    const mistakes = [...this.wrong.values()].flatMap((wrong) => wrong.mistakes);
    const rest = this.form.complain(mistakes);
    const one = (path: string, { text, mistakes: own }: Wrong): HTMLElement => {
      const why = own.map(({ message }) => message).join("; ");
      const runs = this.good[path] ?? "the case's own value";
      return element("p", {}, `${path} = ${text}: ${why}. Runs go on with ${runs}.`);
    };
    this.bar.replaceChildren(...[...this.wrong].map(([path, wrong]) => one(path, wrong)));
    return rest;
  }

  /** A field, or all of them, are no longer wrong: something else was typed. */
  private forgive(path?: string): void {
    if (path === undefined) {
      this.wrong.clear();
    } else {
      this.wrong.delete(path);
    }
    this.complain();
  }

  private take(answer: Answer, wanted: Wanted, { live, first }: { live: boolean; first: boolean }): void {
    const { summary, view, loop, sections, seconds } = answer;
    this.last = JSON.stringify(wanted);
    this.good = wanted.set;
    const rest = this.complain();
    this.form.show(sections, this.set, first, (path) => this.wrong.has(path) || within(this.set, path) !== within(wanted.set, path));
    const notes = [...rest, ...summary.warnings.map((message) => ({ path: "", message, help: "" }))];
    if (summary.failed) {
      notes.push({ path: "", message: "The run has failed: do not use its numbers.", help: "" });
    }
    if (summary.stopped) {
      notes.unshift({ path: "", message: `The run stopped at ${summary.stopped.time.toPrecision(4)} s: ${summary.stopped.reason}`, help: "Values far from the thesis's are the first suspects." });
    }
    if (summary.derailed) {
      notes.unshift({ path: "", message: `The run derailed at ${summary.derailed.time.toPrecision(4)} s: ${summary.derailed.what}`, help: "All values are of the part until then." });
    }
    if (loop.missing) {
      notes.push({ path: "", message: `No energy per ${loop.energy_per}: ${loop.missing}`, help: "" });
    }
    this.show(notes);
    const found = new Data(view).run(summary.name);
    if (found) {
      this.loops.add({ label: this.label, ...loopOf(found, loop), seconds, live });
    }
    this.number += 1;
    this.root.dataset.runs = String(this.number);
    window.clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.scene(view, summary.name), this.view ? REST : 0);
  }

  /** The plots and the 3D view of a run, as those of the one before were left. */
  private scene(view: ViewDocument, name: string): void {
    const data = new Data(view).run(name);
    const before = this.view?.chosen;
    this.view?.dispose();
    this.view = undefined;
    if (data) {
      this.view = new RunView(data, this.units, () => this.switchUnits(), before);
      this.stage.replaceChildren(this.view.root);
      this.view.takePlace();
    }
  }

  private show(notes: Mistake[]): void {
    this.faults.replaceChildren(...notes.map(({ message, help }) => element("p", {}, help ? `${message}\n${help}` : message)));
  }

  private async keep(file: string): Promise<void> {
    const outcome = await keep(this.wanted(), file);
    if (outcome?.is === "mistakes") {
      this.show(this.form.complain(outcome.mistakes));
    } else if (outcome?.is === "failed") {
      this.show([{ path: "", message: outcome.why, help: "" }]);
    } else if (outcome) {
      this.status.textContent = `${file} was not saved: another run came between. Try again.`;
    }
  }
}

async function begin(root: HTMLElement): Promise<void> {
  try {
    const start = await opening();
    const outcome = await run({ preset: start.preset, set: {} });
    if (outcome.is !== "answer") {
      throw new Error(why(outcome));
    }
    new Explorer(start, outcome.answer, root);
    root.dataset.explorer = "ready";
  } catch (error) {
    root.replaceChildren(element("p", { class: "wx-faults", role: "alert" }, `The explorer cannot begin: ${error instanceof Error ? error.message : String(error)}`));
  }
}

const root = document.getElementById("explorer");
if (root) {
  void begin(root);
}
