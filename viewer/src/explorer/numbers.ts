// Numbers of sliders: places, texts as they are typed.

import type { Measured } from "./api.js";

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

/** The range of a slider that is there, wider if the value is outside. */
export function widened(first: Measured, now: Measured): Measured {
  if (first.unit !== now.unit) {
    return now;
  }
  const inside = now.value >= first.low && now.value <= first.high;
  return { ...now, ...(inside ? { low: first.low, high: first.high } : {}) };
}

/** A text as TOML. */
export function quoted(text: string): string {
  return JSON.stringify(text);
}
