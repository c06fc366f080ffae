// Keys of a run's view, while it has the focus.

import type { Clock } from "./clock.js";

export interface Keyed {
  clock: Clock;
  step(rows: number): void;
  look(view: number): void;
  orbit(about: number, up: number, nearer: number): void;
  changeFactor(by: 1 | -1): void;
  nextUnits(): void;
  flatten(): void;
  nameBodies(): void;
  fill(on?: boolean): void;
}

/** What a key does; undefined if nothing. */
export function action(target: Keyed, key: string, shift: boolean): (() => void) | undefined {
  const { clock } = target;
  const rows = shift ? 10 : 1;
  switch (key.length === 1 ? key.toLowerCase() : key) {
    case " ":
      return () => clock.play();
    case "ArrowLeft":
      return () => target.step(-rows);
    case "ArrowRight":
      return () => target.step(rows);
    case "Home":
      return () => clock.set(clock.start);
    case "End":
      return () => clock.set(clock.end);
    case "-":
    case "_":
      return () => clock.changeSpeed(-1);
    case "+":
    case "=":
      return () => clock.changeSpeed(1);
    case "l":
      return () => clock.setLoop(!clock.loop);
    case "w":
      return () => (shift ? target.orbit(0, 0, 0.9) : target.orbit(0, 0.1, 1));
    case "s":
      return () => (shift ? target.orbit(0, 0, 1 / 0.9) : target.orbit(0, -0.1, 1));
    case "a":
      return () => target.orbit(-0.1, 0, 1);
    case "d":
      return () => target.orbit(0.1, 0, 1);
    case "e":
      return () => target.changeFactor(shift ? -1 : 1);
    case "o":
      return () => target.flatten();
    case "n":
      return () => target.nameBodies();
    case "u":
      return () => target.nextUnits();
    case "f":
      return () => target.fill();
    case "Escape":
      return () => target.fill(false);
    default:
      return /^[1-9]$/.test(key) ? () => target.look(Number(key) - 1) : undefined;
  }
}

/** Listens; the result ends it. */
export function keyboard(root: HTMLElement, target: Keyed): () => void {
  const listener = (event: KeyboardEvent): void => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target instanceof HTMLSelectElement) {
      return;
    }
    const onButton = event.target instanceof HTMLButtonElement || event.target instanceof HTMLInputElement;
    if (event.key === " " && onButton && !(event.target instanceof HTMLInputElement && event.target.type === "range")) {
      return;
    }
    const act = action(target, event.key, event.shiftKey);
    if (act) {
      event.preventDefault();
      act();
    }
  };
  root.addEventListener("keydown", listener);
  return () => root.removeEventListener("keydown", listener);
}
