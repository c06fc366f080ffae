// How numbers are shown in either system of units.

import type { Quantity, System } from "./contract.js";

export class Units {
  constructor(
    private readonly quantities: Record<string, Quantity>,
    readonly system: System,
  ) {}

  /** The factor from SI. */
  factor(quantity: string | null): number {
    return this.system === "us" && quantity !== null ? (this.quantities[quantity]?.us_from_si ?? 1) : 1;
  }

  label(quantity: string | null): string {
    return quantity === null ? "" : (this.quantities[quantity]?.[this.system] ?? "");
  }

  axis(name: string, quantity: string | null): string {
    const unit = this.label(quantity);
    return unit ? `${name} (${unit})` : name;
  }

  /** An SI value with its unit. */
  text(si: number, quantity: string | null): string {
    const unit = this.label(quantity);
    const number = digits(si * this.factor(quantity));
    return unit ? `${number} ${unit}` : number;
  }
}

/** About four digits and a true minus sign. */
export function digits(value: number): string {
  if (!Number.isFinite(value)) {
    return "–";
  }
  // Rounded first: 999.99 has no decimals.
  const size = Math.abs(Number(value.toPrecision(4)));
  let text: string;
  if (size === 0) {
    text = "0";
  } else if (size < 1e-4 || size >= 1e7) {
    text = value.toExponential(2);
  } else {
    const decimals = Math.min(6, Math.max(0, 3 - Math.floor(Math.log10(size))));
    text = value.toFixed(size >= 1000 ? 0 : decimals);
  }
  return text.replace("-", "\u2212");
}
