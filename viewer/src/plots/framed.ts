// What plots of a run have in common: a frame that is drawn anew in other units, and follows its room.

import uPlot from "uplot";

import { element } from "../dom.js";

export abstract class FramedPlot {
  abstract readonly root: HTMLElement;
  protected readonly body: HTMLElement;
  protected readonly legend = element("div", { class: "wl-legend" });
  protected plot: uPlot | undefined;
  /** What ends the watching of stores and clocks. */
  protected stops: (() => void)[] = [];
  private readonly observer: ResizeObserver;

  protected constructor(body: string) {
    this.body = element("div", { class: body });
    this.observer = new ResizeObserver(() => this.resize());
  }

  /** Shows what is of the clock's time. */
  protected abstract show(): void;

  /** Follows the room that the plot has, from now on. */
  protected follow(): void {
    this.observer.observe(this.body);
  }

  dispose(): void {
    for (const stop of this.stops) {
      stop();
    }
    this.observer.disconnect();
    this.plot?.destroy();
    this.root.remove();
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.body;
    if (this.plot && width > 0 && (width !== this.plot.width || height !== this.plot.height)) {
      this.plot.setSize({ width, height });
      this.show();
    }
  }
}

/** A button that saves the curves of a plot. */
export function saveButton(save: () => void): HTMLElement {
  return element("button", { type: "button", class: "wl-save", title: "save these curves as a table (CSV)", onclick: save }, "CSV");
}
