// A contact patch of a wheel: its ellipse, its normal force and its creep force, seen while it presses.

import { CircleGeometry, type Group, Mesh, MeshBasicMaterial, Quaternion, Vector3 } from "three";

import type { Patch } from "../contract.js";
import type { Instant, RunData } from "../data.js";
import { Arrow, FRICTION, NORMAL } from "./arrows.js";

export const ELLIPSE = "#CC2936";
const X = new Vector3(1, 0, 0);
const circle = new CircleGeometry(1, 32);

export class PatchMark {
  readonly normal = new Arrow(NORMAL);
  readonly creep = new Arrow(FRICTION);
  readonly ellipse = new Mesh(
    circle.clone(),
    new MeshBasicMaterial({ color: ELLIPSE, depthTest: false, transparent: true, opacity: 0.85, side: 2 }),
  );
  private readonly read: Record<"normal" | "pressed" | "angle" | "x" | "y" | "z" | "along" | "across" | "a" | "b", (at: Instant) => number>;

  constructor(
    readonly patch: Patch,
    private readonly body: Group,
    run: RunData,
  ) {
    this.ellipse.renderOrder = 8;
    const of = (name: string): ((at: Instant) => number) => run.reader(name);
    const [x, y, z] = patch.place;
    this.read = {
      normal: of(patch.normal_force),
      pressed: run.reader(patch.normal_force, true),
      angle: of(patch.angle),
      x: of(x),
      y: of(y),
      z: of(z),
      along: of(patch.creep[0]),
      across: of(patch.creep[1]),
      a: of(patch.axes[0]),
      b: of(patch.axes[1]),
    };
  }

  get visible(): boolean {
    return this.ellipse.visible;
  }

  /** `length` gives that of a force's arrow. */
  show(at: Instant, length: (force: number) => number, thickness: number): void {
    const { read } = this;
    // Between a row with the patch and one without it nothing is known but that it comes or goes.
    const pressed = read.pressed(at) > 0;
    this.ellipse.visible = pressed;
    if (!pressed) {
      this.normal.hide();
      this.creep.hide();
      return;
    }
    const place = this.body.localToWorld(new Vector3(read.x(at), read.y(at), read.z(at)));
    const tilt = (this.patch.right ? -1 : 1) * read.angle(at);
    const turn = this.body.getWorldQuaternion(new Quaternion()).multiply(new Quaternion().setFromAxisAngle(X, tilt));
    const normal = new Vector3(0, 0, 1).applyQuaternion(turn);
    const size = length(Math.max(0, read.normal(at)));
    // It pushes: its tip is at the patch.
    this.normal.show(place.clone().addScaledVector(normal, -size), normal, size, thickness);
    const force = new Vector3(read.along(at), read.across(at), 0);
    const creep = force.length();
    this.creep.show(place, force.normalize().applyQuaternion(turn), length(creep), thickness);
    this.ellipse.position.copy(place);
    this.ellipse.quaternion.copy(turn);
    this.ellipse.scale.set(Math.max(1e-6, read.a(at)), Math.max(1e-6, read.b(at)), 1);
  }
}
