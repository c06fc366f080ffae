// Names of bodies over the 3D view; those that would cover others are left out.

import { element } from "../dom.js";

export class Names {
  readonly root = element("div", { class: "wl-names" });
  shown = true;

  /** Writes the names at their places, pixels from the upper left corner of a picture of this size. */
  place(names: { name: string; at: [number, number] }[], width: number, height: number): void {
    this.root.hidden = !this.shown;
    if (!this.shown) {
      return;
    }
    const taken: [number, number, number][] = [];
    const free = (x: number, y: number, half: number): boolean =>
      taken.every(([tx, ty, other]) => Math.abs(x - tx) > half + other || Math.abs(y - ty) > 16);
    const marks = names.flatMap(({ name, at: [x, y] }) => {
      const half = 3.6 * name.length + 4;
      const inside = x > half && x < width - half && y > 10 && y < height - 10;
      if (!inside || !free(x, y, half)) {
        return [];
      }
      taken.push([x, y, half]);
      const mark = element("span", {}, name);
      mark.style.transform = `translate(-50%, -50%) translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
      return [mark];
    });
    this.root.replaceChildren(...marks);
  }
}
