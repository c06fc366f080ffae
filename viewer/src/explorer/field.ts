// One field of the case: label, control, what is wrong with it, and back to what it was.

import { element, select } from "../dom.js";
import type { Store } from "../store.js";
import type { Units } from "../units.js";
import type { Field, Measured } from "./api.js";
import { place, quoted, shownIn, STEPS, typed, valueAt, widened, words } from "./numbers.js";

/** `live` while a slider is being moved. */
export type Changed = (path: string, text: string, live: boolean) => void;

export class FieldView {
  readonly root: HTMLElement;
  private readonly control: HTMLElement;
  private readonly message = element("p", { class: "wx-mistake", role: "alert" });
  private readonly also = element("span", { class: "wx-also" });
  private readonly reset: HTMLButtonElement;
  private readonly id: string;
  private measured: Measured | undefined;
  private writers: ((field: Field) => void)[] = [];
  private readonly stop: () => void;

  constructor(
    public field: Field,
    private readonly units: Store<Units>,
    private readonly changed: Changed,
    back: (path: string) => void,
  ) {
    this.id = `field-${field.path.replaceAll(".", "-")}`;
    this.message.id = `${this.id}-mistake`;
    const key = field.path.slice(field.path.indexOf(".") + 1);
    const name = words(key);
    this.reset = element(
      "button",
      { type: "button", class: "wx-reset", "aria-label": `${name}: back to the case's value`, title: "back to the case's value", onclick: () => back(field.path) },
      "↺",
    );
    this.control = this.make(name);
    const help = element("p", { class: "wx-help", id: `${this.id}-help` }, field.help);
    this.root = element(
      "div",
      { class: "wx-field", "data-path": field.path },
      element("div", { class: "wx-line" }, element("label", { for: this.id }, name), this.also, this.reset),
      this.control,
      this.message,
      help,
    );
    help.hidden = field.help === "";
    this.complain("");
    this.mark(false);
    this.stop = units.watch(() => this.rewrite());
  }

  dispose(): void {
    this.stop();
  }

  /** Shows other values of the same kind of field; not where somebody types, nor over what is `newer`. */
  show(field: Field, first: boolean, newer: boolean): void {
    this.field = field;
    if (field.input.type === "number") {
      this.measured = first || !this.measured ? field.input : widened(this.measured, field.input);
    }
    if (!newer && (first || !this.control.contains(document.activeElement) || this.message.textContent === "")) {
      for (const write of this.writers) {
        write(field);
      }
    }
    this.tell();
  }

  /** Says what is wrong; nothing if the text is empty. */
  complain(text: string): void {
    this.message.textContent = text;
    this.message.hidden = text === "";
    this.root.classList.toggle("wx-wrong", text !== "");
    for (const input of this.control.querySelectorAll("input, select, textarea")) {
      input.setAttribute("aria-invalid", String(text !== ""));
    }
  }

  /** Whether it has been changed. */
  mark(set: boolean): void {
    this.reset.hidden = !set;
    this.root.classList.toggle("wx-set", set);
  }

  /** Writes the same values in the units that are shown now; what was typed wrongly stays. */
  private rewrite(): void {
    if (this.message.textContent === "") {
      for (const write of this.writers) {
        write(this.field);
      }
    }
    this.tell();
  }

  /** A number in the units that are shown. */
  private shown(measured: Measured): Measured {
    return shownIn(measured, this.units.value.system);
  }

  /** The value in the units that results are shown in, where it stands there in others. */
  private tell(): void {
    const measured = this.measured && this.shown(this.measured);
    const label = measured && this.units.value.label(measured.kind);
    this.also.textContent = measured && label && label !== measured.unit ? `= ${this.units.value.text(measured.si, measured.kind)}` : "";
  }

  private send(text: string, live = false): void {
    this.changed(this.field.path, text, live);
  }

  /** A line to type in: sent with Enter or when it is left; Escape brings back what was there. */
  private line(attributes: Record<string, string>, value: string, send: (text: string) => void): HTMLInputElement {
    const input = element("input", {
      type: "text",
      autocomplete: "off",
      spellcheck: "false",
      "aria-describedby": `${this.id}-help ${this.id}-mistake`,
      ...attributes,
    });
    input.value = value;
    input.addEventListener("change", () => send(input.value));
    input.addEventListener("keydown", (event) => {
      if (event.key === "Escape") {
        for (const write of this.writers) {
          write(this.field);
        }
      }
    });
    return input;
  }

  private make(name: string): HTMLElement {
    const { field, id } = this;
    const { input } = field;
    switch (input.type) {
      case "number": {
        this.measured = input;
        const line = this.line({ id, class: "wx-typed" }, field.text, (text) => this.send(text));
        const slider = element("input", { type: "range", "aria-label": `${name}, slider`, min: 0, max: STEPS, step: 1 });
        const slide = (live: boolean): void => {
          if (this.measured) {
            const shown = this.shown(this.measured);
            line.value = typed(shown, valueAt(shown, Number(slider.value)));
            slider.setAttribute("aria-valuetext", line.value);
            this.send(line.value, live);
          }
        };
        slider.addEventListener("input", () => slide(true));
        slider.addEventListener("change", () => slide(false));
        this.writers.push(({ text, input: now }) => {
          const shown = now.type === "number" ? this.shown(now) : undefined;
          line.value = shown && now.type === "number" && shown.unit !== now.unit ? typed(shown, shown.value) : text;
          if (this.measured && shown) {
            slider.value = String(place(this.shown(this.measured), shown.value));
            slider.setAttribute("aria-valuetext", line.value);
          }
        });
        this.writers[0]?.(field);
        return element("div", { class: "wx-number" }, slider, line);
      }
      case "triple": {
        const numbers = (now: Field): Measured[] => (now.input.type === "triple" ? now.input.numbers : []);
        const texts = (now: Field): string[] => numbers(now).map((number) => this.shown(number)).map((number) => typed(number, number.value));
        // Numbers that nobody touched are sent as they were typed.
        const send = (): void => {
          const before = texts(this.field);
          const own = numbers(this.field).map((number) => typed(number, number.value));
          this.send(`[${lines.map(({ value }, k) => quoted(value === before[k] ? (own[k] ?? value) : value)).join(", ")}]`);
        };
        const lines = texts(field).map((text, k) =>
          this.line({ class: "wx-typed", ...(k === 0 ? { id } : { "aria-label": `${name}, ${k + 1}` }) }, text, send),
        );
        this.writers.push((now) => texts(now).forEach((text, k) => lines[k] && (lines[k].value = text)));
        return element("div", { class: "wx-triple" }, ...lines);
      }
      case "choice": {
        const list = select({ id }, input.choices.map((choice) => [choice, choice]), field.text, (choice) => this.send(choice));
        this.writers.push(({ text }) => (list.value = text));
        return element("div", {}, list);
      }
      case "several": {
        const boxes = input.choices.map((choice, k) => {
          const box = element("input", { type: "checkbox", value: choice, checked: input.chosen.includes(choice), ...(k === 0 ? { id } : {}) });
          box.addEventListener("change", () => {
            const chosen = boxes.filter(({ checked }) => checked).map(({ value }) => quoted(value));
            this.send(`[${chosen.join(", ")}]`);
          });
          return box;
        });
        this.writers.push(({ input: now }) => {
          for (const box of boxes) {
            box.checked = now.type === "several" && now.chosen.includes(box.value);
          }
        });
        return element(
          "div",
          { class: "wx-several", role: "group", "aria-label": name },
          ...boxes.map((box) => element("label", {}, box, ` ${box.value}`)),
        );
      }
      case "text": {
        const line = this.line({ id, class: "wx-text" }, field.text, (text) => this.send(quoted(text)));
        this.writers.push(({ text }) => (line.value = text));
        return element("div", {}, line);
      }
      case "toml": {
        const area = element("textarea", {
          id,
          class: "wx-toml",
          spellcheck: "false",
          rows: Math.min(8, Math.max(2, field.text.split("\n").length)),
          "aria-describedby": `${id}-help ${id}-mistake`,
        });
        area.addEventListener("change", () => this.send(area.value));
        this.writers.push(({ text, input: now }) => {
          area.value = (now.type === "toml" ? now[this.units.value.system] : undefined) ?? text;
        });
        this.writers[0]?.(field);
        return element("div", {}, area);
      }
    }
  }
}
