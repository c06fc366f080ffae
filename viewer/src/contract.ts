// The document `wedgelab.view/1` that the page holds (docs/view.md). All numbers are SI.

export const SCHEMA = "wedgelab.view/1";

export type System = "us" | "si";
export type Triple = [number, number, number];

export interface Quantity {
  us: string;
  si: string;
  us_from_si: number;
}

export interface Axis {
  name: string;
  quantity: string | null;
}

export interface ChartCurve {
  label: string;
  colour: string;
  width: number;
  dashes: number[];
  x: number;
  y: number;
}

export interface ChartPanel {
  title: string;
  x: Axis;
  y: Axis;
  x_window: [number, number] | null;
  y_names: string[];
  marks: [number, number, string][];
  span: number;
  curves: ChartCurve[];
}

export interface Chart {
  title: string;
  columns: number;
  common_axes: boolean;
  panels: ChartPanel[];
}

export interface Column {
  text?: string;
  quantity: string;
  data?: number;
  value?: number;
}

export interface PlotChoice {
  title: string;
  curves: [string, string][];
}

/** Loops in one plot: columns along both axes, and the names of the curves. */
export interface LoopChoice {
  title: string;
  curves: [string, string, string][];
}

export interface Look {
  name: string;
  from: Triple;
  /** A point and the radius about it; everything if there is none. */
  at?: [Triple, number];
  /** The length of the arrow of a force that few exceed; the scene's if there is none. */
  arrow?: number;
}

export interface Body {
  id: string;
  /** The body in whose axes place and angles are; the fixed ones if there is none. */
  on?: string;
  /** The column of its distance along the track, in whose axes there place and angles are. */
  along?: string;
  /** The column of a turn about its y axis that is never exaggerated. */
  spin?: string;
  position: Triple;
  coordinates: (string | null)[];
  steady: (string | null)[];
}

export type Role = "wedge" | "column" | "pocket" | "seat" | "wheelset" | "wheel" | "body" | "glass" | "lading";

export interface Solid {
  id: string;
  name: string;
  role: Role;
  body: string;
  mount: { position: Triple; angles: Triple };
  vertices: Triple[];
  triangles: Triple[];
  /** Instead of these, of a body of revolution about y: y and radius along its outline. */
  revolved?: [number, number][];
}

export interface End {
  body: string;
  point: Triple;
}

export interface Coil {
  name: string;
  from: End;
  to: End;
  nominal_length: number;
  free_length: number;
  radius: number;
  turns: number;
  force: string | null;
  length: string | null;
}

export interface Contact {
  id: string;
  name: string;
  body: string;
  point: Triple;
  on: string;
  normal: Triple;
  normal_force: string;
  friction: [string, string, string];
  state: string;
  gap: string | null;
}

/** A face with the pressures of its points, place by place across, each from the lower edge up. */
export interface Pressure {
  name: string;
  body: string;
  across: number;
  points: Triple[];
  pressures: string[];
}

/** A contact patch of a wheel, seen while it presses. */
export interface Patch {
  id: string;
  name: string;
  body: string;
  place: [string, string, string];
  /** How far its plane rises to the field side. */
  angle: string;
  right: boolean;
  normal_force: string;
  creep: [string, string];
  axes: [string, string];
}

export interface TrackData {
  from: number;
  step: number;
  /** Places in `data`: x, y, z, heading, grade, roll, left_lateral, ... */
  samples: Record<string, number>;
  rails: [[number, number][], [number, number][]];
  /** Spacing, half length, half width, height of their tops, thickness. */
  ties: [number, number, number, number, number];
}

export interface SceneData {
  factor: number;
  limit: number;
  arrow: number;
  looks: Look[];
  bodies: Body[];
  solids: Solid[];
  coils: Coil[];
  contacts: Contact[];
  pressures?: Pressure[];
  patches?: Patch[];
  track?: TrackData;
  /** The body that the view goes along with, in the axes of the track where it is. */
  follow?: string;
}

export interface Run {
  name: string;
  title: string;
  time: number;
  columns: Record<string, Column>;
  plots: PlotChoice[];
  loops?: LoopChoice[];
  scene: SceneData | null;
}

/** 32-bit numbers as base64, or multiples of a step by their second differences. */
export type List = string | { step: number; differences: string };

export interface ViewDocument {
  schema: string;
  units: System;
  quantities: Record<string, Quantity>;
  data: List[];
  figures: Record<string, Chart>;
  runs: Run[];
}
