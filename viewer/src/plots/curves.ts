// What both kinds of plots share: the path of a curve that may turn back, ranges, the nearest point.

import uPlot from "uplot";

export interface Points {
  x: ArrayLike<number>;
  y: ArrayLike<number>;
}

export type Range = [number, number];

/** Straight lines from point to point, interrupted where a number is missing. */
export const path: uPlot.Series.PathBuilder = (plot, series) => {
  const stroke = new Path2D();
  uPlot.orient(plot, series, (_series, xs, ys, scaleX, scaleY, toX, toY, left, top, width, height) => {
    let down = false;
    for (let k = 0; k < xs.length; k++) {
      const x = xs[k] ?? NaN;
      const y = ys[k] ?? NaN;
      if (!Number.isFinite(x) || !Number.isFinite(y)) {
        down = false;
        continue;
      }
      const px = toX(x, scaleX, width, left);
      const py = toY(y, scaleY, height, top);
      if (down) {
        stroke.lineTo(px, py);
      } else {
        stroke.moveTo(px, py);
      }
      down = true;
    }
  });
  return { stroke, fill: null, clip: null, band: null, gaps: [], flags: 0 };
};

/** The range of numbers with a little air. */
export function around(low: number, high: number): Range {
  if (!(low <= high)) {
    return [0, 1];
  }
  if (low === high) {
    const half = low === 0 ? 1 : 0.5 * Math.abs(low);
    return [low - half, high + half];
  }
  const air = 0.05 * (high - low);
  return [low - air, high + air];
}

/** Lowest and highest ordinate in a part of the abscissa. */
export function extremes(curves: Iterable<Points>, of: "x" | "y", within?: Range): Range {
  let low = Infinity;
  let high = -Infinity;
  for (const curve of curves) {
    for (let k = 0; k < curve.x.length; k++) {
      const x = curve.x[k] ?? NaN;
      const value = curve[of][k] ?? NaN;
      if (Number.isFinite(value) && (!within || (x >= within[0] && x <= within[1]))) {
        low = Math.min(low, value);
        high = Math.max(high, value);
      }
    }
  }
  return [low, high];
}

/** Whether abscissae never turn back, numbers that are missing aside. */
export function rises(xs: ArrayLike<number>): boolean {
  let last = -Infinity;
  for (const x of Array.from(xs)) {
    if (x < last) {
      return false;
    }
    last = Number.isFinite(x) ? x : last;
  }
  return true;
}

/** The point nearest to a place on the screen, by a measure of distances. */
export function nearest(curve: Points, distance: (x: number, y: number) => number): [number, number] {
  let place = -1;
  let least = Infinity;
  for (let k = 0; k < curve.x.length; k++) {
    const own = distance(curve.x[k] ?? NaN, curve.y[k] ?? NaN);
    if (own < least) {
      least = own;
      place = k;
    }
  }
  return [place, least];
}

/** A list in other units. */
export function scaled(values: ArrayLike<number>, factor: number): Float64Array {
  return Float64Array.from({ length: values.length }, (_, k) => (values[k] ?? NaN) * factor);
}

/** Zooms about a place at the wheel, if the plot was clicked before or Ctrl is held: else the page scrolls. */
export function wheelZoom(
  plot: uPlot,
  axes: "x" | "xy",
  apply: (scale: "x" | "y", range: Range) => void,
): void {
  plot.over.addEventListener(
    "wheel",
    (event) => {
      if (!event.ctrlKey && !plot.root.contains(document.activeElement)) {
        return;
      }
      event.preventDefault();
      const by = Math.exp(Math.max(-0.5, Math.min(0.5, event.deltaY * 0.002)));
      const box = plot.over.getBoundingClientRect();
      for (const scale of axes === "x" ? (["x"] as const) : (["x", "y"] as const)) {
        const { min, max } = plot.scales[scale] ?? {};
        if (min === undefined || max === undefined) {
          continue;
        }
        const pixel = scale === "x" ? event.clientX - box.left : event.clientY - box.top;
        const about = plot.posToVal(pixel, scale);
        apply(scale, [about - (about - min) * by, about + (max - about) * by]);
      }
    },
    { passive: false },
  );
}

export const AXIS: Pick<uPlot.Axis, "stroke" | "font" | "labelFont" | "labelSize" | "labelGap" | "grid" | "ticks"> = {
  stroke: "#333",
  font: "12px system-ui, sans-serif",
  labelFont: "12px system-ui, sans-serif",
  labelSize: 24,
  labelGap: 0,
  grid: { stroke: "#e4e4e4", width: 1 },
  ticks: { stroke: "#8c8c8c", width: 1, size: 4 },
};

/** Ticks with a true minus sign, as wide as the widest. */
export function tickTexts(_plot: uPlot, splits: number[]): string[] {
  const step = Math.abs((splits[1] ?? 1) - (splits[0] ?? 0));
  const most = Math.max(...splits.map(Math.abs));
  let decimals = 0;
  while (decimals < 9 && Math.abs(step * 10 ** decimals - Math.round(step * 10 ** decimals)) > 1e-6 * step * 10 ** decimals) {
    decimals++;
  }
  return splits.map((value) => {
    const text = most >= 1e6 || most < 1e-3 ? value.toExponential(1) : value.toFixed(decimals);
    return value === 0 ? "0" : text.replace("-", "\u2212");
  });
}

/** Room for ticks: by the longest text. */
export function tickRoom(_plot: uPlot, texts: string[] | null): number {
  const letters = Math.max(3, ...(texts ?? []).map((text) => text.length));
  return 12 + 7.6 * letters;
}
