// The report's page comes alive: figures, runs, units.

import "uplot/dist/uPlot.min.css";
import "./style.css";

import type { System, ViewDocument } from "./contract.js";
import { Data } from "./data.js";
import { element } from "./dom.js";
import { interactiveFigures } from "./figures.js";
import { RunView } from "./run.js";
import { Store } from "./store.js";
import { Units } from "./units.js";

function start(): void {
  const text = document.getElementById("wedgelab-view")?.textContent;
  if (!text) {
    return;
  }
  const data = new Data(JSON.parse(text) as ViewDocument);
  const systems: Record<System, Units> = {
    us: new Units(data.document.quantities, "us"),
    si: new Units(data.document.quantities, "si"),
  };
  const units = new Store(systems[data.document.units]);
  const switchUnits = (): void => units.set(units.value === systems.us ? systems.si : systems.us);

  const button = element("button", { type: "button", class: "wl-units", onclick: switchUnits });
  units.watch(({ system }) => {
    button.textContent = system === "us" ? "Units: inch-pound" : "Units: SI";
    button.title = `show ${system === "us" ? "SI" : "inch-pound"} units in plots and 3D views`;
    document.documentElement.dataset.units = system;
  });
  document.querySelector("header")?.after(button);

  // Texts and drawings first: views are made when all else is there. A page that was packed may be loaded
  // before it is unpacked and begins here.
  const later = (make: () => void): void => {
    if (document.readyState === "complete") {
      setTimeout(make);
    } else {
      addEventListener("load", () => setTimeout(make), { once: true });
    }
  };

  for (const fold of document.querySelectorAll<HTMLDetailsElement>("details[data-run]")) {
    let view: RunView | undefined;
    const follow = (): void => {
      if (fold.open && !view) {
        const run = data.run(fold.dataset.run ?? "");
        if (run) {
          view = new RunView(run, units, switchUnits, undefined, data.others(run));
          fold.querySelector("summary")?.after(view.root);
        }
      } else if (!fold.open && view) {
        view.fill(false);
        view.dispose();
        view = undefined;
      }
    };
    later(() => {
      fold.addEventListener("toggle", follow);
      follow();
    });
  }

  // What a page opens with.
  for (const place of document.querySelectorAll<HTMLElement>("[data-shown]")) {
    const run = data.run(place.dataset.shown ?? "");
    if (run) {
      later(() => place.append(new RunView(run, units, switchUnits, undefined, data.others(run)).root));
    }
  }

  /** Opens what the address names. */
  const open = (): void => {
    const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
    const fold = target?.closest("details");
    if (target && fold) {
      fold.open = true;
      target.scrollIntoView();
    }
  };
  addEventListener("hashchange", open);
  // A link to where the address already points changes nothing, but its fold may be closed again.
  addEventListener("click", (event) => {
    const link = event.target instanceof Element ? event.target.closest("a") : null;
    if (link?.hash && link.hash === location.hash) {
      open();
    }
  });
  open();
  interactiveFigures(data, units);
  document.documentElement.dataset.viewer = "ready";
}

start();
