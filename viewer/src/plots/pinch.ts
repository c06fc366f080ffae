// Two fingers zoom a plot.

import type uPlot from "uplot";

import type { Range } from "./curves.js";

interface Pinch {
  spread: number;
  /** Of each axis: its range when the fingers came down, and the value between them. */
  axes: { scale: "x" | "y"; size: number; about: number }[];
}

/** The range of `size` in which a value lies at a share of its length. */
export function rangeAt(about: number, share: number, size: number): Range {
  const min = about - share * size;
  return [min, min + size];
}

/** Listens; the answer is whether two fingers are on the plot. */
export function pinchZoom(
  plot: uPlot,
  axes: "x" | "xy",
  apply: (scale: "x" | "y", range: Range) => void,
): () => boolean {
  const { over } = plot;
  let pinch: Pinch | undefined;

  const fingers = ({ targetTouches }: TouchEvent): { spread: number; x: number; y: number } | undefined => {
    const [a, b] = targetTouches;
    if (!a || !b) {
      return undefined;
    }
    const box = over.getBoundingClientRect();
    const spread = Math.max(10, Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY));
    return { spread, x: (a.clientX + b.clientX) / 2 - box.left, y: (a.clientY + b.clientY) / 2 - box.top };
  };

  over.addEventListener("touchstart", (event) => {
    const at = fingers(event);
    if (!at) {
      return;
    }
    const names: ("x" | "y")[] = axes === "x" ? ["x"] : ["x", "y"];
    pinch = {
      spread: at.spread,
      axes: names.flatMap((scale) => {
        const { min, max } = plot.scales[scale] ?? {};
        const ranged = min !== undefined && max !== undefined;
        return ranged ? [{ scale, size: max - min, about: plot.posToVal(at[scale], scale) }] : [];
      }),
    };
  }, { passive: true });

  over.addEventListener(
    "touchmove",
    (event) => {
      const at = fingers(event);
      if (!at || !pinch) {
        return;
      }
      event.preventDefault();
      for (const { scale, size, about } of pinch.axes) {
        const share = scale === "x" ? at.x / over.clientWidth : 1 - at.y / over.clientHeight;
        apply(scale, rangeAt(about, share, (size * pinch.spread) / at.spread));
      }
    },
    { passive: false },
  );

  const end = (event: TouchEvent): void => {
    if (event.targetTouches.length < 2) {
      pinch = undefined;
    }
  };
  over.addEventListener("touchend", end);
  over.addEventListener("touchcancel", end);
  return () => pinch !== undefined;
}
