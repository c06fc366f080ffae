// Numbers of sliders: places, texts as they are typed.

import type { System } from "../contract.js";
import type { Measured } from "./api.js";

type Range = Pick<Measured, "value" | "unit" | "low" | "high">;

/** Steps of a slider. */
export const STEPS = 200;

/** The place of a value on a slider. */
export function place({ low, high, logarithmic }: Measured, value: number): number {
  const share = logarithmic ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
  return Math.round(STEPS * Math.min(1, Math.max(0, share)));
}

/** The value at a place, with as many digits as the steps need. */
export function valueAt({ low, high, logarithmic }: Measured, at: number): number {
  const share = at / STEPS;
  const value = logarithmic ? low * (high / low) ** share : low + share * (high - low);
  if (logarithmic) {
    return Number(value.toPrecision(3));
  }
  const step = (high - low) / STEPS;
  const decimals = Math.max(0, Math.min(12, 1 - Math.floor(Math.log10(step))));
  return Number(value.toFixed(decimals));
}

/** A value as it is typed. */
export function typed({ unit, signs }: Measured, value: number): string {
  const size = String(signs ? Math.abs(value) : value);
  const word = signs && value !== 0 ? signs[value < 0 ? 0 : 1] : "";
  return [size, unit, word].filter(Boolean).join(" ");
}

/** The number in the units of a system; as typed if its unit belongs to both. */
export function shownIn(measured: Measured, system: System): Measured {
  return { ...measured, ...measured[system === "us" ? "in_us" : "in_si"] };
}

/** The range of a slider that is there, wider if the value is outside. */
export function widened(first: Measured, now: Measured): Measured {
  const ranges = [first, first.in_us, first.in_si];
  const inside = (own: Range): boolean => {
    const old = ranges.find((range) => range?.unit === own.unit);
    return old !== undefined && own.value >= old.low && own.value <= old.high;
  };
  const kept = <T extends Range>(own: T): T => {
    const { low, high } = ranges.find((range) => range?.unit === own.unit) ?? own;
    return { ...own, low, high };
  };
  if (!inside(now)) {
    return now;
  }
  return { ...kept(now), ...(now.in_us && { in_us: kept(now.in_us) }), ...(now.in_si && { in_si: kept(now.in_si) }) };
}

/** A path's key in words: `vertical.0.amplitude`, `vertical.points.2.1`. */
export function words(key: string): string {
  const parts = key.split(".").map((part, k, all) => {
    if (!/^\d+$/.test(part)) {
      return part.replaceAll("_", " ");
    }
    const inTable = all.slice(0, k).some((before) => before === "points" || before === "table");
    return !inTable ? `part ${Number(part) + 1}` : k === all.length - 1 ? "value" : `point ${Number(part) + 1}`;
  });
  return parts.join(": ");
}

/** A text as TOML. */
export function quoted(text: string): string {
  return JSON.stringify(text);
}
