// Named views.

import { Vector3 } from "three";

export interface NamedView {
  id: string;
  name: string;
  /** From the target to the eye. */
  from: Vector3;
}

export const VIEWS: NamedView[] = [
  { id: "oblique", name: "Oblique", from: new Vector3(0.45, -1, 0.28) },
  { id: "side", name: "Side", from: new Vector3(0, -1, 0) },
  { id: "column", name: "Column", from: new Vector3(-1, 0, 0) },
  { id: "slope", name: "Slope", from: new Vector3(1, 0, 0.25) },
  // Not quite from above: there the camera would not know which way is up.
  { id: "top", name: "Top", from: new Vector3(0, -0.001, 1) },
];
