// Saving what is seen: a table of curves, a picture.

import { element } from "./dom.js";

export interface SavedColumn {
  name: string;
  values: ArrayLike<number>;
}

/** Columns as CSV: names that hold a comma or a quote are quoted; numbers to nine digits; a number that is missing is an empty cell. */
export function csv(columns: SavedColumn[]): string {
  const quoted = (name: string): string => (/[",\n]/.test(name) ? `"${name.replaceAll('"', '""')}"` : name);
  const rows = Math.max(0, ...columns.map(({ values }) => values.length));
  const cell = (value: number | undefined): string => (value !== undefined && Number.isFinite(value) ? String(Number(value.toPrecision(9))) : "");
  const lines = Array.from({ length: rows }, (_, row) => columns.map(({ values }) => cell(values[row])).join(","));
  return `${[columns.map(({ name }) => quoted(name)).join(","), ...lines].join("\n")}\n`;
}

/** A name that any system takes for a file. */
export function fileName(title: string, ending: string): string {
  const plain = title.normalize("NFKD").replaceAll(/[^A-Za-z0-9.-]+/g, "_").replaceAll(/^[_.]+|_+$/g, "");
  return `${plain || "wedgelab"}.${ending}`;
}

export function saveTable(title: string, columns: SavedColumn[]): void {
  save(new Blob([csv(columns)], { type: "text/csv" }), fileName(title, "csv"));
}

export function save(blob: Blob, name: string): void {
  const address = URL.createObjectURL(blob);
  const link = element("a", { href: address, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
