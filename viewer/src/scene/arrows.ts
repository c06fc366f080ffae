// Corner forces as arrows, contact states as coloured points.

import { ConeGeometry, CylinderGeometry, Group, Mesh, MeshBasicMaterial, SphereGeometry, Vector3 } from "three";

/** Open, stick, slip: as in the static figures. */
export const STATES: [string, string][] = [
  ["open", "#56B4E9"],
  ["stick", "#000000"],
  ["slip", "#E69F00"],
];
export const NORMAL = "#0072B2";
export const FRICTION = "#D55E00";

const UP = new Vector3(0, 0, 1);
const shaft = new CylinderGeometry(1, 1, 1, 8).rotateX(Math.PI / 2).translate(0, 0, 0.5);
const head = new ConeGeometry(1, 1, 12).rotateX(Math.PI / 2).translate(0, 0, -0.5);

/** An arrow that is seen through everything; its head ends at its tip. */
export class Arrow {
  readonly group = new Group();
  private readonly shaft: Mesh;
  private readonly head: Mesh;

  constructor(colour: string) {
    const material = new MeshBasicMaterial({ color: colour, depthTest: false, transparent: true });
    this.shaft = new Mesh(shaft, material);
    this.head = new Mesh(head, material);
    for (const part of [this.shaft, this.head]) {
      part.renderOrder = 10;
    }
    this.group.add(this.shaft, this.head);
    this.group.visible = false;
  }

  get visible(): boolean {
    return this.group.visible;
  }

  hide(): void {
    this.group.visible = false;
  }

  /** From `start` along a direction of length 1; `length` 0 hides it. */
  show(start: Vector3, direction: Vector3, length: number, thickness: number): void {
    this.group.visible = length > 0;
    if (!this.group.visible) {
      return;
    }
    this.group.position.copy(start);
    this.group.quaternion.setFromUnitVectors(UP, direction);
    const tip = Math.min(5 * thickness, 0.6 * length);
    this.shaft.scale.set(thickness, thickness, Math.max(length - tip, 1e-6));
    this.head.position.z = length;
    this.head.scale.set(0.45 * tip, 0.45 * tip, tip);
  }
}

/** A point in the colour of a contact's state. */
export class Dot {
  readonly mesh: Mesh;
  private static readonly materials = STATES.map(
    ([, colour]) => new MeshBasicMaterial({ color: colour, depthTest: false, transparent: true }),
  );

  constructor(radius: number) {
    this.mesh = new Mesh(new SphereGeometry(radius, 12, 8), Dot.materials[0]);
    this.mesh.renderOrder = 9;
  }

  show(place: Vector3, state: number): void {
    this.mesh.position.copy(place);
    const material = Dot.materials[state];
    if (material) {
      this.mesh.material = material;
    }
  }
}
