// The latest loops over the earlier ones, and their energies.

import type { Chart, Quantity, System } from "../contract.js";
import { SCHEMA } from "../contract.js";
import { Data, type RunData } from "../data.js";
import { element } from "../dom.js";
import { FigurePlots } from "../plots/figure.js";
import type { Store } from "../store.js";
import { type Units } from "../units.js";
import type { Shown } from "./api.js";

/** How many loops are shown. */
export const MOST = 8;

export interface Loop {
  number: number;
  /** Which loop it is, and the quantities of its axes. */
  shown: Shown;
  quantities: [string, string];
  /** What was changed. */
  label: string;
  travel: Float32Array;
  force: Float32Array;
  seconds: number;
  /** Whether a slider was still being moved. */
  live: boolean;
}

/** The loops' numbers as a figure has them. */
class Lists extends Data {
  constructor(
    quantities: Record<string, Quantity>,
    units: System,
    private readonly lists: Float32Array[],
  ) {
    super({ schema: SCHEMA, units, quantities, data: [], figures: {}, runs: [] });
  }

  override list(place: number): Float32Array {
    return this.lists[place] ?? new Float32Array();
  }
}

/** Colours that people with any kind of colour vision tell apart (Okabe and Ito), and a brown. */
const COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#8c6d31"];

/** The colour of a run, which stays while later ones come; no two that are shown have the same. */
export function colour(number: number): string {
  return COLOURS[(number - 1) % COLOURS.length] ?? "#000000";
}

export function loopOf(run: RunData, shown: Shown): Pick<Loop, "shown" | "quantities" | "travel" | "force"> {
  const { x, y } = shown;
  return {
    shown,
    quantities: [run.quantity(x.column), run.quantity(y.column)],
    travel: run.values(x.column),
    force: run.values(y.column),
  };
}

export class Loops {
  readonly root = element("section", { class: "wx-loops", "aria-label": "Loops" });
  private readonly place = element("div");
  private readonly rows = element("tbody");
  private readonly head = element("th", { scope: "col" });
  private readonly caption = element("caption");
  private readonly loops: Loop[] = [];
  private plots: FigurePlots | undefined;
  private count = 0;

  constructor(
    private readonly quantities: Record<string, Quantity>,
    private readonly units: Store<Units>,
  ) {
    this.root.append(
      this.place,
      element(
        "div",
        { class: "wx-wide" },
        element(
          "table",
          {},
          this.caption,
          element("thead", {}, element("tr", {}, element("th", { scope: "col" }, "run"), element("th", { scope: "col" }, "changed"), this.head, element("th", { scope: "col" }, "computed in"))),
          this.rows,
        ),
      ),
    );
    units.watch(() => this.table());
  }

  /** Puts a loop over the others; one that came while a slider moved gives way to the next. */
  add(loop: Omit<Loop, "number">): void {
    // Loops of other axes are no company.
    if (this.loops[0] && this.loops[0].shown.title !== loop.shown.title) {
      this.loops.length = 0;
    }
    if (this.loops[0]?.live) {
      this.loops.shift();
      this.count -= 1;
    }
    this.count += 1;
    this.loops.unshift({ ...loop, number: this.count });
    this.loops.length = Math.min(this.loops.length, MOST);
    this.draw();
  }

  /** The latest loop stays. */
  settle(): void {
    if (this.loops[0]) {
      this.loops[0].live = false;
    }
  }

  clear(): void {
    const [latest] = this.loops;
    this.loops.length = latest ? 1 : 0;
    this.draw();
  }

  private draw(): void {
    const [latest] = this.loops;
    if (!latest) {
      return;
    }
    const { shown, quantities } = latest;
    this.caption.textContent = `${shown.energy_of}, the latest run first`;
    const lists = this.loops.flatMap(({ travel, force }) => [travel, force]);
    const curves = this.loops.map(({ number }, k) => ({
      label: `run ${number}`,
      colour: colour(number),
      width: k === 0 ? 2.4 : 1.2,
      dashes: [],
      x: 2 * k,
      y: 2 * k + 1,
    }));
    const chart: Chart = {
      title: "Loops",
      columns: 1,
      common_axes: true,
      panels: [
        {
          title: shown.title,
          x: { name: shown.x.name, quantity: quantities[0] },
          y: { name: shown.y.name, quantity: quantities[1] },
          x_window: null,
          y_names: [],
          marks: [],
          span: 1,
          // The latest on top.
          curves: curves.reverse(),
        },
      ],
    };
    this.plots?.dispose();
    const data = new Lists(this.quantities, this.units.value.system, lists);
    this.plots = new FigurePlots(chart, data, this.units, 480);
    this.place.replaceChildren(this.plots.root);
    this.plots.refit();
    this.root.dataset.loops = String(this.loops.length);
    this.root.dataset.run = String(this.count);
    this.root.dataset.energy = String(shown.energy ?? "");
    this.table();
  }

  private table(): void {
    const units = this.units.value;
    const per = this.loops[0]?.shown.energy_per ?? "cycle";
    this.head.textContent = `energy per ${per} (${units.label("energy")})`;
    this.rows.replaceChildren(
      ...this.loops.map(({ number, label, shown: { energy }, seconds }) => {
        const mark = element("i", { class: "wl-stroke" });
        mark.style.background = colour(number);
        const shown = energy === null ? "–" : (energy * units.factor("energy")).toFixed(1).replace("-", "\u2212");
        return element(
          "tr",
          {},
          element("th", { scope: "row" }, mark, ` ${number}`),
          element("td", {}, label),
          element("td", { class: "wx-energy" }, shown),
          element("td", { class: "wx-energy" }, `${(1000 * seconds).toFixed(0)} ms`),
        );
      }),
    );
  }
}
