// A plot of a run's columns over time, with a playhead on the run's clock.

import uPlot from "uplot";

import type { Clock } from "../clock.js";
import type { Instant, RunData } from "../data.js";
import { element, select } from "../dom.js";
import { Store } from "../store.js";
import { saveTable } from "../save.js";
import { digits, type Units } from "../units.js";
import { around, AXIS, extremes, scaled, tickRoom, tickTexts, wheelZoom, type Range } from "./curves.js";
import { swatch } from "./figure.js";
import { FramedPlot, saveButton } from "./framed.js";
import { pinchZoom } from "./pinch.js";

/** Colours (Okabe and Ito, 2008) and lines, as in the static figures. */
export const STYLES: [string, number[]][] = [
  ["#0072B2", []],
  ["#000000", [9, 4]],
  ["#D55E00", [10, 3, 2, 3]],
  ["#009E73", [2, 3]],
];

/** What a plot shows: its title, and the columns that are hidden. */
export interface Shown {
  title: string;
  hidden: string[];
}

export class RunPlot extends FramedPlot {
  readonly root = element("div", { class: "wl-plot" });
  private readonly playhead = element("div", { class: "wl-playhead" });
  private readonly hidden = new Set<string>();
  private values: { show: (text: string) => void; read: (at: Instant) => number }[] = [];

  constructor(
    private readonly run: RunData,
    private readonly clock: Clock,
    private readonly units: Store<Units>,
    /** The part of the run that all its plots show. */
    private readonly window: Store<Range>,
    private choice: number,
    before?: Shown,
    /** A run that is drawn beside this one. */
    private readonly other: Store<RunData | undefined> = new Store<RunData | undefined>(undefined),
  ) {
    super("wl-plot-body");
    const same = run.run.plots.findIndex(({ title }) => title === before?.title);
    if (before && same >= 0) {
      this.choice = same;
      before.hidden.forEach((name) => this.hidden.add(name));
    }
    const options = run.run.plots.map(({ title }, k): [string, string] => [String(k), title]);
    const chooser = select({ "aria-label": "What this plot shows", class: "wl-choice" }, options, String(this.choice), (chosen) => {
      this.choice = Number(chosen);
      this.hidden.clear();
      this.build(units.value);
    });
    this.root.append(element("div", { class: "wl-plot-head" }, element("div", { class: "wl-plot-line" }, chooser, saveButton(() => this.save())), this.legend), this.body);
    this.stops = [
      other.watch(() => this.build(units.value)),
      units.watch((now) => this.build(now)),
      window.watch(([min, max]) => this.plot?.setScale("x", { min, max })),
      clock.watch(() => this.show()),
    ];
    this.follow();
  }

  get shown(): Shown {
    return { title: this.run.run.plots[this.choice]?.title ?? "", hidden: [...this.hidden] };
  }

  private build(units: Units): void {
    this.plot?.destroy();
    const chosen = this.run.run.plots[this.choice];
    const curves = (chosen?.curves ?? []).filter(([name]) => name in this.run.run.columns);
    const quantity = curves[0] ? this.run.quantity(curves[0][0]) : "dimensionless";
    const columns = curves.map(([name]) => scaled(this.run.values(name), units.factor(quantity)));
    const times = Float64Array.from(this.run.times);
    const beside = this.beside(curves);
    const range = (): Range => {
      const shown = columns.filter((_, k) => !this.hidden.has(curves[k]?.[0] ?? ""));
      const all = [...shown, ...beside.map(({ values }) => values)];
      return around(...extremes(all.map((y) => ({ x: times, y })), "y", this.window.value));
    };
    const options: uPlot.Options = {
      width: Math.max(200, this.body.clientWidth),
      height: Math.max(120, this.body.clientHeight),
      legend: { show: false },
      padding: [8, 20, 0, 0],
      cursor: { drag: { x: false, y: false }, points: { show: false }, x: false, y: false },
      scales: { x: { time: false, auto: false }, y: { range } },
      axes: [
        { ...AXIS, size: 22, label: "", labelSize: 0, values: (plot, splits) => tickTexts(plot, splits).map((t, k) => (k === splits.length - 1 ? `${t} s` : t)) },
        { ...AXIS, size: tickRoom, label: units.label(quantity), values: tickTexts },
      ],
      series: [
        {},
        ...curves.map(([name, label], k) => {
          const [stroke, dash] = STYLES[k % STYLES.length] ?? ["#000", []];
          return { label, stroke, dash, width: 1.4, show: !this.hidden.has(name), points: { show: false } };
        }),
        // The other run's are pale under the same colours.
        ...beside.map(({ label, place }) => ({ label, stroke: `${(STYLES[place % STYLES.length] ?? ["#000000"])[0]}80`, width: 3, points: { show: false } })),
      ],
    };
    this.plot = new uPlot(options, [times, ...columns, ...beside.map(({ values }) => values)] as uPlot.AlignedData, this.body);
    const [min, max] = this.window.value;
    this.plot.setScale("x", { min, max });
    this.plot.over.append(this.playhead);
    this.listen(this.plot);
    this.entries(curves);
    this.show();
  }

  /** The other run's columns at this run's times, as far as it goes. */
  private beside(curves: [string, string][]): { label: string; place: number; values: Float64Array }[] {
    const other = this.other.value;
    if (!other) {
      return [];
    }
    const units = this.units.value;
    return curves.flatMap(([name, label], place) => {
      if (!(name in other.run.columns)) {
        return [];
      }
      const [read, factor] = [other.reader(name), units.factor(other.quantity(name))];
      const within = (time: number): boolean => time >= other.start && time <= other.end;
      const values = Float64Array.from(this.run.times, (time) => (within(time) ? read(other.at(time)) * factor : NaN));
      return [{ label: `${label}, ${other.run.name}`, place, values }];
    });
  }

  /** Saves what is shown, in the units that are shown. */
  private save(): void {
    const { run } = this;
    const units = this.units.value;
    const chosen = run.run.plots[this.choice];
    const curves = (chosen?.curves ?? []).filter(([name]) => name in run.run.columns && !this.hidden.has(name));
    const column = ([name]: [string, string]): { name: string; values: Float64Array } => ({
      name: units.axis(name, run.quantity(name)),
      values: scaled(run.values(name), units.factor(run.quantity(name))),
    });
    const beside = this.beside(curves).map(({ label, place, values }) => ({ name: units.axis(label, run.quantity(curves[place]?.[0] ?? "")), values }));
    const times = { name: "time_s", values: Float64Array.from(run.times) };
    saveTable(`${run.run.name} ${chosen?.title ?? ""}`, [times, ...curves.map(column), ...beside]);
  }

  private listen(plot: uPlot): void {
    const { over } = plot;
    over.classList.add("wl-scrub");
    over.tabIndex = -1;
    const scrub = (event: PointerEvent): void => {
      this.clock.set(plot.posToVal(event.clientX - over.getBoundingClientRect().left, "x"));
    };
    over.addEventListener("pointerdown", (event) => {
      if (!event.isPrimary) {
        return;
      }
      over.setPointerCapture(event.pointerId);
      this.clock.play(false);
      scrub(event);
    });
    over.addEventListener("pointermove", (event) => {
      if (event.buttons & 1 && event.isPrimary && !pinching()) {
        scrub(event);
      }
    });
    over.addEventListener("dblclick", () => this.window.set([this.run.start, this.run.end]));
    const zoom = (_scale: "x" | "y", [min, max]: Range): void => {
      this.window.set([Math.max(this.run.start, min), Math.min(this.run.end, max)]);
    };
    wheelZoom(plot, "x", zoom);
    const pinching = pinchZoom(plot, "x", zoom);
  }

  private entries(curves: [string, string][]): void {
    this.values = [];
    const buttons = curves.map(([name, label], k) => {
      const [colour, dashes] = STYLES[k % STYLES.length] ?? ["#000", []];
      const value = element("output", { class: "wl-value", "data-column": name });
      const show = !this.hidden.has(name);
      const button = element(
        "button",
        { type: "button", class: "wl-entry", "aria-pressed": String(show), title: "show or hide" },
        swatch(colour, dashes, 2),
        `${label}: `,
        value,
      );
      button.addEventListener("click", () => {
        const hide = !this.hidden.has(name);
        if (hide) {
          this.hidden.add(name);
        } else {
          this.hidden.delete(name);
        }
        button.setAttribute("aria-pressed", String(!hide));
        this.plot?.setSeries(k + 1, { show: !hide });
      });
      this.values.push({ show: (text) => (value.textContent = text), read: this.run.reader(name) });
      return button;
    });
    this.legend.replaceChildren(...buttons);
  }

  /** Puts the playhead and the values at the clock's time. */
  protected override show(): void {
    const { plot } = this;
    if (!plot) {
      return;
    }
    const time = this.clock.time;
    const left = plot.valToPos(time, "x");
    const inside = Number.isFinite(left) && left >= 0 && left <= plot.over.clientWidth;
    this.playhead.style.transform = `translateX(${inside ? left.toFixed(1) : 0}px)`;
    this.playhead.style.visibility = inside ? "visible" : "hidden";
    this.root.dataset.time = time.toFixed(4);
    const at = this.run.at(time);
    const quantity = this.run.quantity(this.run.run.plots[this.choice]?.curves[0]?.[0] ?? "");
    const units = this.units.value;
    for (const { show, read } of this.values) {
      show(`${digits(read(at) * units.factor(quantity))} ${units.label(quantity)}`);
    }
  }
}
