// The document's lists of numbers, decoded when they are first asked for.

import type { List, Run, ViewDocument } from "./contract.js";
import { SCHEMA } from "./contract.js";

const bytesOf = (text: string): Uint8Array => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));

/** Little-endian 32-bit numbers as base64, or second differences of multiples of a step, seven bits a byte. */
export function decode(list: List): Float32Array {
  if (typeof list !== "string") {
    return summed(bytesOf(list.differences), list.step);
  }
  const bytes = bytesOf(list);
  const view = new DataView(bytes.buffer);
  return Float32Array.from({ length: bytes.length >> 2 }, (_, i) => view.getFloat32(4 * i, true));
}

function summed(bytes: Uint8Array, step: number): Float32Array {
  const values = new Float32Array(bytes.reduce((count, byte) => count + (byte < 128 ? 1 : 0), 0));
  let [last, slope, place, shift, number] = [0, 0, 0, 0, 0];
  for (const byte of bytes) {
    number |= (byte & 127) << shift;
    shift += 7;
    if (byte < 128) {
      slope += (number >>> 1) ^ -(number & 1);
      last += slope;
      values[place] = last * step;
      place += 1;
      [shift, number] = [0, 0];
    }
  }
  return values;
}

export class Data {
  private readonly decoded = new Map<number, Float32Array>();

  constructor(readonly document: ViewDocument) {
    if (document.schema !== SCHEMA) {
      throw new Error(`the page's data are ${document.schema}; this viewer reads ${SCHEMA}`);
    }
  }

  list(place: number): Float32Array {
    const there = this.decoded.get(place);
    if (there) {
      return there;
    }
    const list = decode(this.document.data[place] ?? "");
    this.decoded.set(place, list);
    return list;
  }

  /** The runs that share a plot with this one, which may be drawn beside it. */
  others(run: RunData): RunData[] {
    const names = new Set(run.run.plots.flatMap(({ curves }) => curves.map(([name]) => name)));
    const alike = (own: Run): boolean => own !== run.run && own.plots.some(({ curves }) => curves.some(([name]) => names.has(name)));
    return this.document.runs.filter(alike).map((own) => new RunData(own, this));
  }

  run(name: string): RunData | undefined {
    const run = this.document.runs.find((own) => own.name === name);
    return run && new RunData(run, this);
  }
}

/** A place between two output times. */
export interface Instant {
  time: number;
  row: number;
  share: number;
}

/** A run's columns by name. */
export class RunData {
  readonly times: Float32Array;

  constructor(
    readonly run: Run,
    private readonly data: Data,
  ) {
    this.times = data.list(run.time);
  }

  get end(): number {
    return this.times[this.times.length - 1] ?? 0;
  }

  get start(): number {
    return this.times[0] ?? 0;
  }

  /** All values; a constant column is filled up. */
  values(name: string): Float32Array {
    const column = this.run.columns[name];
    if (column?.data !== undefined) {
      return this.data.list(column.data);
    }
    return new Float32Array(this.times.length).fill(column?.value ?? NaN);
  }

  /** A list of the document by its place. */
  list(place: number | undefined): Float32Array | undefined {
    return place === undefined ? undefined : this.data.list(place);
  }

  quantity(name: string): string {
    return this.run.columns[name]?.quantity ?? "dimensionless";
  }

  /** Finds a time between the rows. */
  at(time: number): Instant {
    const times = this.times;
    let low = 0;
    let high = times.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if ((times[middle] ?? 0) <= time) {
        low = middle;
      } else {
        high = middle;
      }
    }
    const from = times[low] ?? 0;
    const to = times[high] ?? from;
    const share = to > from ? Math.min(1, Math.max(0, (time - from) / (to - from))) : 0;
    return { time, row: low, share };
  }

  /** A function that gives a column's value: straight between rows, or that of the row before. */
  reader(name: string | null, steps = false): (at: Instant) => number {
    const column = name === null ? undefined : this.run.columns[name];
    if (column?.data === undefined) {
      const value = column?.value ?? 0;
      return () => value;
    }
    const values = this.data.list(column.data);
    return ({ row, share }) => {
      const from = values[row] ?? 0;
      if (steps) {
        return share < 1 ? from : (values[row + 1] ?? from);
      }
      return from + share * ((values[row + 1] ?? from) - from);
    };
  }
}
