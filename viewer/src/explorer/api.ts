// Requests and answers, `wedgelab.explore/1` (docs/explore.md).

import type { ViewDocument } from "../contract.js";

/** A number with its range in a unit. */
export interface InUnits {
  text: string;
  value: number;
  unit: string;
  low: number;
  high: number;
}

export interface Measured {
  value: number;
  unit: string;
  si: number;
  kind: string;
  low: number;
  high: number;
  logarithmic: boolean;
  signs: [string, string] | null;
  /** The same in the other units, where it is typed in those of one system. */
  in_us?: InUnits;
  in_si?: InUnits;
}

export type Input =
  | ({ type: "number" } & Measured)
  | { type: "triple"; numbers: [Measured, Measured, Measured] }
  | { type: "choice"; choices: string[] }
  | { type: "several"; choices: string[]; chosen: string[] }
  | { type: "text" }
  | { type: "toml"; us?: string; si?: string };

export interface Field {
  path: string;
  help: string;
  text: string;
  input: Input;
}

export interface Section {
  name: string;
  about: string;
  fields: Field[];
}

export interface Opening {
  schema: string;
  preset: string | null;
  name: string;
  presets: { name: string; title: string; look_at: string; cases: { name: string; title: string }[] }[];
  sections: Section[];
}

/** A case with changes, each as `--set` takes it. */
export interface Wanted {
  preset: string | null;
  set: Record<string, string>;
}

export interface Summary {
  name: string;
  title: string;
  units: "us" | "si";
  complete: boolean;
  stopped: { time: number; reason: string } | null;
  /** Of cars: a wheel left its rail, where the run ended. */
  derailed?: { time: number; what: string } | null;
  failed: string | null;
  warnings: string[];
}

/** An axis of the loop: a column of the run, and in words. */
export interface LoopAxis {
  column: string;
  name: string;
}

/** The loop that is shown over earlier ones. */
export interface Shown {
  title: string;
  x: LoopAxis;
  y: LoopAxis;
  energy_of: string;
  /** Of what it is the energy: of a cycle, or of the run. */
  energy_per: string;
  /** J. */
  energy: number | null;
  /** Why there is none; empty where there is one. */
  missing: string;
}

export interface Answer {
  schema: string;
  view: ViewDocument;
  summary: Summary;
  loop: Shown;
  sections: Section[];
  seconds: number;
}

export interface Mistake {
  path: string;
  message: string;
  help: string;
}

export type Outcome =
  | { is: "answer"; answer: Answer }
  | { is: "mistakes"; mistakes: Mistake[] }
  | { is: "replaced" }
  | { is: "failed"; why: string };

/**
 * The secret of the address that the terminal shows; the server answers only who sends it. It stays in the address, so
 * that the page can be loaded again.
 */
function authorization(): Record<string, string> {
  return { authorization: `Bearer ${new URLSearchParams(location.search).get("token") ?? ""}` };
}

async function post(path: string, wanted: Wanted): Promise<Response> {
  const headers = { ...authorization(), "content-type": "application/json" };
  return fetch(path, { method: "POST", headers, body: JSON.stringify(wanted) });
}

const GONE = "The server does not answer: `wedgelab explore` has been stopped. Start it again and open the address it prints.";

async function refused(response: Response): Promise<Exclude<Outcome, { is: "answer" }>> {
  if (response.status === 409) {
    return { is: "replaced" };
  }
  const text = await response.text();
  try {
    const { errors, message } = JSON.parse(text) as { errors?: Mistake[]; message?: string };
    if (errors) {
      return { is: "mistakes", mistakes: errors };
    }
    return { is: "failed", why: message ?? text };
  } catch {
    return { is: "failed", why: text };
  }
}

/** Why nothing can be shown, in words. */
export function why(outcome: Exclude<Outcome, { is: "answer" }>): string {
  switch (outcome.is) {
    case "mistakes":
      return outcome.mistakes.map(({ message }) => message).join("; ");
    case "failed":
      return outcome.why;
    case "replaced":
      return "replaced by another window: reload the page";
  }
}

export async function opening(): Promise<Opening> {
  const response = await fetch("/api/case", { headers: authorization() });
  if (!response.ok) {
    const outcome = await refused(response);
    throw new Error(why(outcome));
  }
  return (await response.json()) as Opening;
}

export async function run(wanted: Wanted): Promise<Outcome> {
  try {
    const response = await post("/api/run", wanted);
    return response.ok ? { is: "answer", answer: (await response.json()) as Answer } : await refused(response);
  } catch {
    return { is: "failed", why: GONE };
  }
}

/** Keeps a file of what is wanted; says why if it cannot. */
export async function keep(wanted: Wanted, file: string): Promise<Outcome | undefined> {
  try {
    const response = await post(`/api/export/${file}`, wanted);
    if (!response.ok) {
      return await refused(response);
    }
    const name = /filename="([^"]*)"/.exec(response.headers.get("content-disposition") ?? "")?.[1] ?? file;
    const address = URL.createObjectURL(await response.blob());
    const link = document.createElement("a");
    link.href = address;
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(address), 10_000);
    return undefined;
  } catch {
    return { is: "failed", why: GONE };
  }
}
