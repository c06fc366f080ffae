// A figure of the report as plots that zoom, tell values, and show and hide curves.

import uPlot from "uplot";

import type { Chart, ChartPanel } from "../contract.js";
import type { Data } from "../data.js";
import { element } from "../dom.js";
import type { Store } from "../store.js";
import { digits, type Units } from "../units.js";
import {
  around,
  AXIS,
  extremes,
  nearest,
  path,
  rises,
  scaled,
  tickRoom,
  tickTexts,
  wheelZoom,
  type Points,
  type Range,
} from "./curves.js";
import { pinchZoom } from "./pinch.js";

// The enumeration exists in uPlot's types only.
// eslint-disable-next-line @typescript-eslint/no-unsafe-enum-assignment
const FACETED: uPlot.Mode = 2;

interface PanelPlot {
  plot: uPlot;
  place: HTMLElement;
}

export class FigurePlots {
  readonly root = element("div", { class: "wl-figure" });
  private readonly grid = element("div", { class: "wl-panels" });
  private readonly hidden = new Set<string>();
  private panels: PanelPlot[] = [];
  private readonly stop: () => void;
  private readonly observer: ResizeObserver;
  /** Whether a reader zoomed or hid something. */
  touched = false;

  constructor(
    private readonly chart: Chart,
    private readonly data: Data,
    private readonly units: Store<Units>,
    private readonly height: number,
  ) {
    this.root.append(this.grid, this.legend());
    this.stop = units.watch((now) => this.build(now));
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(this.root);
  }

  dispose(): void {
    this.stop();
    this.observer.disconnect();
    this.clear();
    this.root.remove();
  }

  private clear(): void {
    for (const { plot } of this.panels) {
      plot.destroy();
    }
    this.panels = [];
    this.grid.replaceChildren();
  }

  /** After it was put into the page: as wide as there is room. */
  refit(): void {
    this.build(this.units.value);
  }

  private get cells(): number {
    const all = this.chart.panels.reduce((sum, panel) => sum + panel.span, 0);
    return this.chart.columns === 0 ? all : this.chart.columns;
  }

  private build(units: Units): void {
    this.clear();
    const narrow = this.grid.clientWidth > 0 && this.grid.clientWidth < 560;
    this.grid.style.gridTemplateColumns = narrow ? "minmax(0, 1fr)" : `repeat(${this.cells}, minmax(0, 1fr))`;
    const shown = this.chart.panels.map((panel) => points(panel, this.data, units));
    const common = this.chart.common_axes
      ? ranges(this.chart.panels, shown.flat(), units)
      : undefined;
    this.chart.panels.forEach((panel, number) => {
      const place = element("div", { class: "wl-panel" });
      if (!narrow) {
        place.style.gridColumn = `span ${panel.span}`;
      }
      this.grid.append(place);
      const own = shown[number] ?? [];
      this.panels.push({ plot: this.panel(panel, own, common ?? ranges([panel], own, units), units, place), place });
    });
  }

  private get panelHeight(): number {
    const rows = Math.ceil(this.chart.panels.reduce((sum, panel) => sum + panel.span, 0) / this.cells);
    const narrow = this.grid.clientWidth < 560;
    return narrow ? 260 : Math.max(220, (this.height - 40) / rows - 50);
  }

  private size(place: HTMLElement): { width: number; height: number } {
    return { width: Math.max(200, place.clientWidth), height: this.panelHeight };
  }

  private resize(): void {
    for (const { plot, place } of this.panels) {
      const { width, height } = this.size(place);
      if (Math.abs(width - plot.width) > 1 || Math.abs(height - plot.height) > 1) {
        plot.setSize({ width, height });
      }
    }
  }

  private panel(
    panel: ChartPanel,
    curves: Points[],
    [x, y]: [Range, Range],
    units: Units,
    place: HTMLElement,
  ): uPlot {
    const named = panel.y_names.length > 0;
    const readout = element("p", { class: "wl-readout", "aria-live": "off" }, "\u00a0");
    const scale = (range: Range): uPlot.Scale => ({ time: false, auto: false, range: (_plot, min: number | null, max: number | null) => [min ?? range[0], max ?? range[1]] });
    const facets = [
      { scale: "x", auto: false },
      { scale: "y", auto: false },
    ];
    const options: uPlot.Options = {
      ...this.size(place),
      // Every curve has its own abscissae.
      mode: FACETED,
      title: panel.title,
      legend: { show: false },
      padding: [8, 12, 0, 0],
      cursor: { drag: { x: true, y: true, uni: 24, dist: 4 }, points: { show: false }, dataIdx: () => null },
      scales: { x: scale(x), y: scale(y) },
      axes: [
        { ...AXIS, size: 26, label: units.axis(panel.x.name, panel.x.quantity), values: tickTexts },
        {
          ...AXIS,
          ...(named
            ? { size: 130, splits: () => panel.y_names.map((_, k) => k), values: () => panel.y_names }
            : { size: tickRoom, label: units.axis(panel.y.name, panel.y.quantity), values: tickTexts }),
        },
      ],
      series: [
        {},
        ...panel.curves.map((curve) => ({
          label: curve.label,
          stroke: curve.colour,
          width: curve.width,
          dash: curve.dashes,
          cap: "butt" as const,
          paths: path,
          facets,
          show: !this.hidden.has(curve.label),
        })),
      ],
      hooks: {
        draw: [
          (plot) => {
            const { ctx } = plot;
            ctx.save();
            ctx.fillStyle = "#1b1b1b";
            ctx.font = `${12 * devicePixelRatio}px system-ui, sans-serif`;
            ctx.textAlign = "center";
            for (const [mx, my, text] of panel.marks) {
              const px = plot.valToPos(mx * units.factor(panel.x.quantity), "x", true);
              const py = plot.valToPos(my * units.factor(panel.y.quantity), "y", true);
              const { left, top, width, height } = plot.bbox;
              if (px >= left && px <= left + width && py >= top && py <= top + height) {
                ctx.fillText(text, px, py);
              }
            }
            ctx.restore();
          },
        ],
        setSelect: [() => (this.touched = true)],
      },
    };
    const data = [null, ...curves.map(({ x: xs, y: ys }) => [xs, ys])] as unknown as uPlot.AlignedData;
    const plot = new uPlot(options, data, place);
    const reset = (): void => {
      plot.batch(() => {
        plot.setScale("x", { min: x[0], max: x[1] });
        plot.setScale("y", { min: y[0], max: y[1] });
      });
    };
    reset();
    plot.over.tabIndex = -1;
    plot.over.addEventListener("pointerdown", () => plot.over.focus({ preventScroll: true }));
    plot.over.addEventListener("dblclick", reset);
    const axes = named ? "x" : "xy";
    const zoom = (name: "x" | "y", [min, max]: Range): void => {
      this.touched = true;
      plot.setScale(name, { min, max });
    };
    wheelZoom(plot, axes, zoom);
    pinchZoom(plot, axes, zoom);
    plot.over.addEventListener("mousemove", (event) => {
      readout.textContent = this.read(plot, panel, curves, units, event.offsetX, event.offsetY);
    });
    plot.over.addEventListener("mouseleave", () => (readout.textContent = "\u00a0"));
    place.append(readout);
    return plot;
  }

  /** What is under the pointer: all curves at this abscissa, or the nearest point of a loop. */
  private read(plot: uPlot, panel: ChartPanel, curves: Points[], units: Units, px: number, py: number): string {
    const visible = curves.flatMap((points, k) => {
      const curve = panel.curves[k];
      return curve && !this.hidden.has(curve.label) ? [{ points, label: curve.label }] : [];
    });
    const toX = (x: number): number => plot.valToPos(x, "x");
    const toY = (y: number): number => plot.valToPos(y, "y");
    const unit = (quantity: string | null): string => {
      const label = units.label(quantity);
      return label && ` ${label}`;
    };
    const xUnit = unit(panel.x.quantity);
    if (panel.y_names.length > 0) {
      const row = Math.round(plot.posToVal(py, "y"));
      const at = plot.posToVal(px, "x");
      const here = visible.find(({ points }) => covers(points, at, row));
      return `${digits(at)}${xUnit}: ${panel.y_names[row] ?? ""}${here ? `: ${here.label}` : ""}`;
    }
    if (visible.every(({ points }) => rises(points.x))) {
      const found = visible.map(({ points, label }) => {
        const [place] = nearest(points, (x) => Math.abs(toX(x) - px));
        return { label, x: points.x[place] ?? NaN, y: points.y[place] ?? NaN };
      });
      const values = found.map(({ label, y }) => `${label ? `${label}: ` : ""}${digits(y)}`).join("; ");
      return `${digits(found[0]?.x ?? NaN)}${xUnit}: ${values}${unit(panel.y.quantity)}`;
    }
    let best = { text: "\u00a0", distance: Infinity };
    for (const { points, label } of visible) {
      const [place, distance] = nearest(points, (x, y) => Math.hypot(toX(x) - px, toY(y) - py));
      if (distance < best.distance) {
        const [x, y] = [points.x[place] ?? NaN, points.y[place] ?? NaN];
        const name = label ? `${label}: ` : "";
        best = { text: `${name}${digits(x)}${xUnit}, ${digits(y)}${unit(panel.y.quantity)}`, distance };
      }
    }
    return best.text;
  }

  private legend(): HTMLElement {
    const entries = new Map<string, ChartPanel["curves"][number]>();
    for (const curve of this.chart.panels.flatMap((panel) => panel.curves)) {
      if (curve.label && !entries.has(curve.label)) {
        entries.set(curve.label, curve);
      }
    }
    const buttons = [...entries].map(([label, curve]) => {
      const button = element("button", { type: "button", class: "wl-entry", "aria-pressed": "true", title: "show or hide" });
      button.append(swatch(curve.colour, curve.dashes, curve.width), label);
      button.addEventListener("click", () => {
        this.touched = true;
        const hide = !this.hidden.has(label);
        if (hide) {
          this.hidden.add(label);
        } else {
          this.hidden.delete(label);
        }
        button.setAttribute("aria-pressed", String(!hide));
        this.panels.forEach(({ plot }, number) => {
          this.chart.panels[number]?.curves.forEach((own, k) => {
            if (own.label === label) {
              plot.setSeries(k + 1, { show: !hide });
            }
          });
        });
      });
      return button;
    });
    return element("div", { class: "wl-legend" }, ...buttons);
  }
}

/** A short piece of a curve. */
export function swatch(colour: string, dashes: number[], width: number): SVGSVGElement {
  const space = "http://www.w3.org/2000/svg";
  const picture = document.createElementNS(space, "svg");
  picture.setAttribute("viewBox", "0 0 28 10");
  picture.setAttribute("width", "28");
  picture.setAttribute("height", "10");
  picture.setAttribute("aria-hidden", "true");
  const line = document.createElementNS(space, "path");
  line.setAttribute("d", "M0 5h28");
  line.setAttribute("stroke", colour);
  line.setAttribute("stroke-width", String(Math.max(2, width)));
  if (dashes.length > 0) {
    line.setAttribute("stroke-dasharray", dashes.join(" "));
  }
  picture.append(line);
  return picture;
}

function points(panel: ChartPanel, data: Data, units: Units): Points[] {
  return panel.curves.map((curve) => ({
    x: scaled(data.list(curve.x), units.factor(panel.x.quantity)),
    y: scaled(data.list(curve.y), units.factor(panel.y.quantity)),
  }));
}

/** The ranges that are shown first. */
function ranges(panels: ChartPanel[], curves: Points[], units: Units): [Range, Range] {
  const first = panels[0];
  const window = panels.find((panel) => panel.x_window)?.x_window ?? null;
  const factor = units.factor(first?.x.quantity ?? null);
  const x: Range = window ? [window[0] * factor, window[1] * factor] : around(...extremes(curves, "x"));
  const names = Math.max(0, ...panels.map((panel) => panel.y_names.length));
  const y: Range = names > 0 ? [-0.5, names - 0.5] : around(...extremes(curves, "y", x));
  return [x, y];
}

function covers({ x, y }: Points, at: number, row: number): boolean {
  for (let k = 0; k + 1 < x.length; k++) {
    if (y[k] === row && y[k + 1] === row && (x[k] ?? NaN) <= at && at <= (x[k + 1] ?? NaN)) {
      return true;
    }
  }
  return false;
}
