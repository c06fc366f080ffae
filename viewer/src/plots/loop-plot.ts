// Loops of a run: one column over another, with points that move on the run's clock.

import uPlot from "uplot";

import type { Clock } from "../clock.js";
import type { LoopChoice } from "../contract.js";
import type { Instant, RunData } from "../data.js";
import { element, select } from "../dom.js";
import { saveTable, type SavedColumn } from "../save.js";
import type { Store } from "../store.js";
import type { Units } from "../units.js";
import { around, AXIS, extremes, path, scaled, tickRoom, tickTexts, type Points } from "./curves.js";
import { swatch } from "./figure.js";
import { FramedPlot, saveButton } from "./framed.js";
import { STYLES } from "./run-plot.js";

// The enumeration exists in uPlot's types only.
// eslint-disable-next-line @typescript-eslint/no-unsafe-enum-assignment
const FACETED: uPlot.Mode = 2;

interface Moving {
  mark: HTMLElement;
  x: (at: Instant) => number;
  y: (at: Instant) => number;
}

export class LoopPlot extends FramedPlot {
  readonly root = element("div", { class: "wl-loop", role: "group" });
  private moving: Moving[] = [];
  private factors: [number, number] = [1, 1];
  private choice = 0;

  constructor(
    private readonly run: RunData,
    private readonly clock: Clock,
    private readonly units: Store<Units>,
    private readonly loops: LoopChoice[],
    private readonly other: Store<RunData | undefined>,
  ) {
    super("wl-loop-body");
    this.root.setAttribute("aria-label", "Loop with the point of this moment");
    const options = loops.map(({ title }, k): [string, string] => [String(k), title]);
    const chooser = select({ "aria-label": "Which loop is shown", class: "wl-choice" }, options, "0", (chosen) => {
      this.choice = Number(chosen);
      this.build(units.value);
    });
    this.root.append(element("div", { class: "wl-plot-line" }, chooser, saveButton(() => this.save())), this.body, this.legend);
    this.stops = [units.watch((now) => this.build(now)), other.watch(() => this.build(units.value)), clock.watch(() => this.show())];
    this.follow();
  }

  /** The curves of a run, as far as it has their columns. */
  private curves(run: RunData): { label: string; place: number; columns: [string, string]; points: Points }[] {
    const units = this.units.value;
    const values = (name: string): Float64Array => scaled(run.values(name), units.factor(run.quantity(name)));
    return (this.loops[this.choice]?.curves ?? []).flatMap(([x, y, label], place) => {
      const there = x in run.run.columns && y in run.run.columns;
      return there ? [{ label, place, columns: [x, y] as [string, string], points: { x: values(x), y: values(y) } }] : [];
    });
  }

  private build(units: Units): void {
    this.plot?.destroy();
    const [own, others] = [this.curves(this.run), this.other.value ? this.curves(this.other.value) : []];
    const all = [...others, ...own].map(({ points }) => points);
    const [x, y] = (["x", "y"] as const).map((of) => around(...extremes(all, of)));
    const [xs, ys] = own[0]?.columns ?? ["", ""];
    const quantities = [this.run.quantity(xs), this.run.quantity(ys)] as const;
    this.factors = [units.factor(quantities[0]), units.factor(quantities[1])];
    const facets = [{ scale: "x", auto: false }, { scale: "y", auto: false }];
    const colour = (place: number): string => (STYLES[place % STYLES.length] ?? ["#000000"])[0];
    const series = (label: string, stroke: string, width: number): uPlot.Series => ({ label, stroke, width, cap: "butt", paths: path, facets });
    const words = (name: string): string => name.replaceAll("_", " ");
    const options: uPlot.Options = {
      width: Math.max(200, this.body.clientWidth),
      height: Math.max(160, this.body.clientHeight),
      mode: FACETED,
      legend: { show: false },
      padding: [8, 14, 0, 0],
      cursor: { show: false },
      scales: { x: { time: false, auto: false, range: () => x ?? [0, 1] }, y: { auto: false, range: () => y ?? [0, 1] } },
      axes: [
        { ...AXIS, size: 22, label: units.axis(words(xs), quantities[0]), values: tickTexts },
        { ...AXIS, size: tickRoom, label: units.label(quantities[1]), values: tickTexts },
      ],
      series: [
        {},
        ...others.map(({ label, place }) => series(`${label}, ${this.other.value?.run.name ?? ""}`, `${colour(place)}80`, 3)),
        ...own.map(({ label, place }) => series(label, colour(place), 1.2)),
      ],
    };
    const data = [null, ...[...others, ...own].map(({ points }) => [points.x, points.y])] as unknown as uPlot.AlignedData;
    this.plot = new uPlot(options, data, this.body);
    this.moving = own.map(({ place, columns }) => {
      const mark = element("div", { class: "wl-point" });
      mark.style.background = colour(place);
      this.plot?.over.append(mark);
      return { mark, x: this.run.reader(columns[0]), y: this.run.reader(columns[1]) };
    });
    const entry = (label: string, place: number, wide: boolean): HTMLElement =>
      element("span", { class: "wl-entry" }, swatch(`${colour(place)}${wide ? "80" : ""}`, [], wide ? 4 : 2), label);
    this.legend.replaceChildren(
      ...own.map(({ label, place }) => entry(label, place, false)),
      ...others.map(({ label, place }) => entry(`${label}, ${this.other.value?.run.name ?? ""}`, place, true)),
    );
    this.show();
  }

  /** Puts the points where the clock's time is. */
  protected override show(): void {
    const { plot } = this;
    if (!plot) {
      return;
    }
    const at = this.run.at(this.clock.time);
    const told = this.moving.map(({ mark, x, y }): [number, number] => {
      const place: [number, number] = [x(at) * this.factors[0], y(at) * this.factors[1]];
      const [left, top] = [plot.valToPos(place[0], "x"), plot.valToPos(place[1], "y")];
      mark.style.transform = `translate(${left.toFixed(1)}px, ${top.toFixed(1)}px)`;
      return place;
    });
    this.root.dataset.points = JSON.stringify(told);
  }

  private save(): void {
    const units = this.units.value;
    const columns = (run: RunData, ending: string): SavedColumn[] =>
      this.curves(run).flatMap(({ columns: names, points }) =>
        names.map((name, k) => ({ name: units.axis(`${name}${ending}`, run.quantity(name)), values: k === 0 ? points.x : points.y })),
      );
    const other = this.other.value;
    const title = `${this.run.run.name} ${this.loops[this.choice]?.title ?? ""}`;
    saveTable(title, [...columns(this.run, ""), ...(other ? columns(other, ` of ${other.run.name}`) : [])]);
  }
}
