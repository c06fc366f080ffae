// All fields of the case in sections that fold.

import { element } from "../dom.js";
import type { Store } from "../store.js";
import type { Units } from "../units.js";
import type { Field, Mistake, Section } from "./api.js";
import { FieldView, type Changed } from "./field.js";

const TITLES: Record<string, string> = {
  "": "Case",
  wedge: "Wedge",
  control_coil: "Control coil",
  contact: "Contact",
  friction: "Friction",
  side_frame: "Side frame",
  bolster: "Bolster",
  environment: "Environment",
  simulation: "Simulation",
};

/** Open at first. */
const OPEN = ["friction", "side_frame", "bolster"];

/** What must be the same for controls to be kept. */
function shape({ path, input }: Field): string {
  return `${path} ${input.type}`;
}

export class Form {
  readonly root = element("form", { class: "wx-form", "aria-label": "The case" });
  private readonly views = new Map<string, FieldView>();
  private readonly folds = new Map<string, boolean>(OPEN.map((name) => [name, true]));
  private shapes = "";

  constructor(
    private readonly units: Store<Units>,
    private readonly changed: Changed,
    private readonly back: (path: string) => void,
  ) {
    this.root.addEventListener("submit", (event) => event.preventDefault());
  }

  /**
   * Shows the values; `first` if they are another case's, so that sliders get new ranges. What `newer` names has been
   * changed since these values were asked for, a slider that is being moved, say: it stays as it is.
   */
  show(sections: Section[], set: Record<string, string>, first: boolean, newer: (path: string) => boolean): void {
    const shapes = sections.flatMap(({ fields }) => fields.map(shape)).join("\n");
    if (shapes !== this.shapes) {
      this.build(sections);
      this.shapes = shapes;
    }
    for (const field of sections.flatMap(({ fields }) => fields)) {
      const view = this.views.get(field.path);
      view?.show(field, first, newer(field.path));
      view?.mark(field.path in set);
    }
  }

  /** Shows what is wrong where it was typed; gives what belongs to no field. */
  complain(mistakes: Mistake[]): Mistake[] {
    const rest: Mistake[] = [];
    const texts = new Map<string, string[]>();
    for (const mistake of mistakes) {
      if (!this.views.has(mistake.path)) {
        rest.push(mistake);
        continue;
      }
      const text = mistake.help ? `${mistake.message}\n${mistake.help}` : mistake.message;
      texts.set(mistake.path, [...(texts.get(mistake.path) ?? []), text]);
    }
    for (const [path, view] of this.views) {
      const own = texts.get(path);
      view.complain(own?.join("\n") ?? "");
      if (own) {
        const fold = view.root.closest("details");
        if (fold) {
          fold.open = true;
        }
      }
    }
    return rest;
  }

  mark(path: string, set: boolean): void {
    this.views.get(path)?.mark(set);
  }

  private build(sections: Section[]): void {
    const focused = document.activeElement?.id;
    for (const view of this.views.values()) {
      view.dispose();
    }
    this.views.clear();
    const folds = sections.map(({ name, about, fields }) => {
      const views = fields.map((field) => {
        const view = new FieldView(field, this.units, this.changed, this.back);
        this.views.set(field.path, view);
        return view.root;
      });
      const fold = element(
        "details",
        { class: "wx-section", open: this.folds.get(name) ?? false },
        element("summary", {}, TITLES[name] ?? name),
      );
      if (about) {
        fold.append(element("p", { class: "wx-about" }, about));
      }
      fold.append(...views);
      fold.addEventListener("toggle", () => this.folds.set(name, fold.open));
      return fold;
    });
    this.root.replaceChildren(...folds);
    if (focused) {
      document.getElementById(focused)?.focus({ preventScroll: true });
    }
  }
}
