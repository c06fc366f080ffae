// Figures of the page become interactive when they come into view, and drawings again when they are far away.

import type { Chart } from "./contract.js";
import type { Data } from "./data.js";
import { element } from "./dom.js";
import { scaled } from "./plots/curves.js";
import { FigurePlots } from "./plots/figure.js";
import { saveTable, type SavedColumn } from "./save.js";
import type { Store } from "./store.js";
import type { Units } from "./units.js";

/** Abscissa and ordinate of every curve, in the units that are shown. */
function curveColumns(chart: Chart, data: Data, units: Units): SavedColumn[] {
  return chart.panels.flatMap((panel) =>
    panel.curves.flatMap((curve) =>
      ([["x", panel.x], ["y", panel.y]] as const).map(([axis, { name, quantity }]) => ({
        name: [panel.title, curve.label, units.axis(name, quantity)].filter(Boolean).join(": "),
        values: scaled(data.list(curve[axis]), units.factor(quantity)),
      })),
    ),
  );
}

export function interactiveFigures(data: Data, units: Store<Units>): void {
  const shown = new Map<Element, FigurePlots>();
  const kept = new Set<Element>();

  const enliven = (figure: HTMLElement): void => {
    const chart = data.document.figures[figure.dataset.figure ?? ""];
    const drawing = figure.querySelector("svg");
    if (!chart || !drawing || shown.has(figure)) {
      return;
    }
    const plots = new FigurePlots(chart, data, units, drawing.getBoundingClientRect().height);
    shown.set(figure, plots);
    figure.classList.add("wl-live");
    drawing.before(plots.root);
    plots.refit();
  };
  const still = (figure: HTMLElement): void => {
    shown.get(figure)?.dispose();
    shown.delete(figure);
    figure.classList.remove("wl-live");
  };

  const near = new IntersectionObserver(
    (entries) => {
      for (const { target, isIntersecting } of entries) {
        const figure = target as HTMLElement;
        if (isIntersecting && !kept.has(figure)) {
          enliven(figure);
        } else if (!isIntersecting && !shown.get(figure)?.touched) {
          still(figure);
        }
      }
    },
    { rootMargin: "60px" },
  );

  for (const figure of document.querySelectorAll<HTMLElement>("figure[data-figure]")) {
    if (!data.document.figures[figure.dataset.figure ?? ""]) {
      continue;
    }
    const button = element("button", { type: "button", class: "wl-switch" }, "drawing");
    button.title = "between the interactive plot and the drawing that is printed";
    button.addEventListener("click", () => {
      if (shown.has(figure)) {
        kept.add(figure);
        still(figure);
        button.textContent = "interactive";
      } else {
        kept.delete(figure);
        enliven(figure);
        button.textContent = "drawing";
      }
    });
    const save = element("button", { type: "button", class: "wl-save" }, "CSV");
    save.title = "save the curves of this figure as a table";
    save.addEventListener("click", () => {
      const chart = data.document.figures[figure.dataset.figure ?? ""];
      if (chart) {
        saveTable(chart.title, curveColumns(chart, data, units.value));
      }
    });
    figure.querySelector("figcaption")?.append(" ", button, " ", save);
    near.observe(figure);
  }
}
