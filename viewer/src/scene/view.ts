// The 3D view of a run: what is seen at an instant.

import {
  Box3,
  Color,
  Group,
  Mesh,
  type Object3D,
  OrthographicCamera,
  PerspectiveCamera,
  Quaternion,
  Scene,
  Sphere,
  Vector3,
  WebGLRenderer,
  LineSegments,
  type Material,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

import type { Coil, Contact, SceneData } from "../contract.js";
import type { Instant, RunData } from "../data.js";
import { Arrow, Dot, FRICTION, NORMAL } from "./arrows.js";
import { PatchMark } from "./patch.js";
import { PressureMark, typicalPressure } from "./pressure.js";
import { poser, type Poser } from "./pose.js";
import { coilMesh, solidMesh, turn } from "./solids.js";
import { Track } from "./track.js";

interface Moved {
  id: string;
  group: Group;
  pose: Poser;
  spin: ((at: Instant) => number) | undefined;
}

/** The track's axes where a body is. */
interface Along {
  id: string;
  group: Group;
  distance: (at: Instant) => number;
}

interface Mounted {
  /** Its group turns with its angles, times the factor. */
  group: Group;
  angles: [number, number, number];
}

/** Where the eye is and what it looks at. */
export interface Eye {
  position: Vector3;
  target: Vector3;
  /** Whether the projection is parallel, and how many metres the picture is high then. */
  flat?: boolean;
  height?: number;
}

interface Touch {
  contact: Contact;
  body: Group;
  on: Group;
  /** The axes of its friction force; the fixed ones if there are none. */
  axes: Group | undefined;
  normal: Arrow;
  friction: Arrow;
  dot: Dot;
  readNormal: (at: Instant) => number;
  readFriction: ((at: Instant) => number)[];
  readState: (at: Instant) => number;
}

interface Sprung {
  coil: Coil;
  mesh: Mesh;
  from: Group;
  to: Group;
}

const Z = new Vector3(0, 0, 1);
const FIELD = 26;
/** With more solids than this, bodies are named instead. */
const SOLIDS = 12;
/** Arrows longer than this many times the scale's force are cut. */
export const LONGEST = 2.5;

/** How far a track is seen, m. */
const TRACK_SEEN = 150;

/** Milliseconds of rest before a fine picture. */
const REST = 250;

let software: boolean | undefined;

/** Whether WebGL is computed without a graphics processor; asked once, for the answer takes a while. */
function drawsInSoftware(): boolean {
  return (software ??= asksForSoftware());
}

function asksForSoftware(): boolean {
  const context = document.createElement("canvas").getContext("webgl2");
  if (!context) {
    return false;
  }
  const info = context.getExtension("WEBGL_debug_renderer_info");
  const name = String(context.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : context.RENDERER));
  context.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

export class SceneView {
  readonly canvas: HTMLCanvasElement;
  readonly controls: OrbitControls;
  private readonly perspective = new PerspectiveCamera(FIELD, 1, 0.01, 20);
  private readonly parallel = new OrthographicCamera(-1, 1, 1, -1, 0.01, 20);
  /** Whether the projection is parallel: that of named views along an axis. */
  flat = false;
  private aspect = 1;
  private readonly dark = matchMedia("(prefers-color-scheme: dark)");
  private readonly paper = (): void => {
    // A page that knows light colours alone stays light.
    const dark = this.dark.matches && getComputedStyle(document.documentElement).colorScheme.includes("dark");
    this.scene.background = new Color(dark ? 0x1b2127 : 0xf7f9fb);
    this.refresh();
  };
  /** The force whose arrow has the length `arrow`: of contacts, or of patches where there are no contacts. */
  readonly scaleForce: number;
  /** The pressure of the strongest colour; none without faces that have pressures. */
  readonly scalePressure: number | undefined;
  /** That of patches beside contacts, where it is another one. */
  readonly patchForce: number | undefined;
  arrow: number;
  factor: number;
  arrowFactor = 1;
  private readonly scene = new Scene();
  private readonly renderer: WebGLRenderer;
  private readonly moved: Moved[] = [];
  private readonly mounted: Mounted[] = [];
  private readonly touches: Touch[] = [];
  private readonly sprung: Sprung[] = [];
  private readonly patches: PatchMark[] = [];
  private readonly pressures: PressureMark[] = [];
  private readonly along: Along[] = [];
  private readonly track: Track | undefined;
  /** All that is in the fixed axes, moved so that what is followed stays. */
  private readonly world = new Group();
  private readonly ball: Sphere;
  private stale = true;
  private readonly software: boolean;
  private density = 1;
  private fine = false;
  private lastDrawn = 0;
  private shown: Instant | undefined;

  constructor(
    private readonly data: SceneData,
    run: RunData,
  ) {
    this.factor = data.factor;
    this.software = drawsInSoftware();
    this.renderer = new WebGLRenderer({ antialias: !this.software, powerPreference: "low-power" });
    this.canvas = this.renderer.domElement;
    this.dark.addEventListener("change", this.paper);
    this.paper();

    this.scene.add(this.world);
    const { track } = data;
    this.track = track && new Track(track, (name) => run.list(track.samples[name]));
    const bodies = new Map<string, Group>();
    for (const body of data.bodies) {
      const group = new Group();
      bodies.set(body.id, group);
      this.moved.push({ id: body.id, group, pose: poser(body, run), spin: body.spin === undefined ? undefined : run.reader(body.spin) });
      // A body stands in the list after the one it is on.
      let parent: Object3D = bodies.get(body.on ?? "") ?? this.world;
      if (body.along !== undefined) {
        const frame = new Group();
        frame.matrixAutoUpdate = false;
        this.along.push({ id: body.id, group: frame, distance: run.reader(body.along) });
        parent.add(frame);
        parent = frame;
      }
      parent.add(group);
    }
    const none = new Group();
    const solids = new Map<string, Group>();
    for (const solid of data.solids) {
      const group = solidMesh(solid);
      group.position.set(...solid.mount.position);
      (bodies.get(solid.body) ?? none).add(group);
      this.mounted.push({ group, angles: solid.mount.angles });
      solids.set(solid.id, group);
    }
    this.named.push(...names(data, solids, bodies));
    for (const coil of data.coils) {
      const mesh = coilMesh(coil, data.coils.length > 4);
      this.scene.add(mesh);
      this.sprung.push({ coil, mesh, from: bodies.get(coil.from.body) ?? none, to: bodies.get(coil.to.body) ?? none });
    }
    // The nominal position gives the view and the sizes.
    this.place({ time: 0, row: 0, share: 0 }, 1);
    this.ball = new Box3().setFromObject(this.scene).getBoundingSphere(new Sphere());
    if (this.track) {
      this.world.add(this.track.group);
    }
    this.arrow = data.arrow;
    const patches = data.patches ?? [];
    const both = data.contacts.length > 0 && patches.length > 0;
    this.scaleForce = typicalForce(data.contacts.length > 0 ? data.contacts : patches, run);
    this.patchForce = both ? typicalForce(patches, run) : undefined;
    const faces = data.pressures ?? [];
    this.scalePressure = faces.length > 0 ? typicalPressure(faces, run) : undefined;
    for (const face of faces) {
      const mark = new PressureMark(face, run, this.scalePressure ?? 1);
      (bodies.get(face.body) ?? none).add(mark.mesh);
      this.pressures.push(mark);
    }
    for (const patch of patches) {
      const mark = new PatchMark(patch, bodies.get(patch.body) ?? none, run);
      this.scene.add(mark.normal.group, mark.creep.group, mark.ellipse);
      this.patches.push(mark);
    }
    // Those of the track where a body runs along, itself or the one that it is on.
    const trackAxes = (id: string | undefined): Group | undefined => {
      const own = this.along.find((along) => along.id === id);
      const on = data.bodies.find((body) => body.id === id)?.on;
      return own?.group ?? (on === undefined ? undefined : trackAxes(on));
    };
    for (const contact of data.contacts) {
      const touch: Touch = {
        contact,
        body: bodies.get(contact.body) ?? none,
        on: solids.get(contact.on) ?? none,
        axes: trackAxes(contact.body),
        normal: new Arrow(NORMAL),
        friction: new Arrow(FRICTION),
        dot: new Dot(0.048 * this.arrow),
        readNormal: run.reader(contact.normal_force),
        readFriction: contact.friction.map((name) => run.reader(name)),
        readState: run.reader(contact.state, true),
      };
      this.scene.add(touch.normal.group, touch.friction.group, touch.dot.mesh);
      this.touches.push(touch);
    }

    this.perspective.up.copy(Z);
    this.parallel.up.copy(Z);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enableDamping = false;
    // The nearest look is not too near.
    const nearest = data.looks.reduce((least, { at }) => Math.min(least, at?.[1] ?? least), this.arrow);
    this.controls.minDistance = 2 * nearest;
    this.controls.maxDistance = 20 * this.ball.radius;
    for (const camera of [this.perspective, this.parallel]) {
      camera.near = 0.2 * nearest;
      camera.far = Math.max(22 * this.ball.radius, this.track ? TRACK_SEEN : 0);
    }
    this.controls.addEventListener("change", () => this.refresh());
  }

  dispose(): void {
    this.controls.dispose();
    this.dark.removeEventListener("change", this.paper);
    this.track?.dispose();
    this.scene.traverse((object) => {
      if (object instanceof Mesh || object instanceof LineSegments) {
        const drawn = object as Mesh;
        drawn.geometry.dispose();
        (drawn.material as Material).dispose();
      }
    });
    this.renderer.dispose();
    this.renderer.forceContextLoss();
    this.canvas.remove();
  }

  /** Asks for a new picture. */
  refresh(): void {
    this.stale = true;
  }

  resize(width: number, height: number, density: number): void {
    this.density = this.software ? 1 : Math.min(2, density);
    this.fine = false;
    this.renderer.setPixelRatio(this.density);
    this.renderer.setSize(width, height, false);
    this.aspect = width / Math.max(1, height);
    this.perspective.aspect = this.aspect;
    this.perspective.updateProjectionMatrix();
    this.frame(this.height);
    this.refresh();
  }

  get camera(): PerspectiveCamera | OrthographicCamera {
    return this.flat ? this.parallel : this.perspective;
  }

  /** Metres from the lower to the upper edge of the picture, at the target. */
  private get height(): number {
    if (this.flat) {
      return (this.parallel.top - this.parallel.bottom) / this.parallel.zoom;
    }
    return 2 * this.perspective.position.distanceTo(this.controls.target) * Math.tan((FIELD / 2) * (Math.PI / 180));
  }

  /** Makes the parallel projection this high, m. */
  private frame(height: number): void {
    const half = 0.5 * height;
    Object.assign(this.parallel, { top: half, bottom: -half, left: -half * this.aspect, right: half * this.aspect, zoom: 1 });
    this.parallel.updateProjectionMatrix();
  }

  /** Changes the projection; what is at the target stays as large. */
  flatten(flat: boolean): void {
    if (flat === this.flat) {
      return;
    }
    const { height } = this;
    const arm = this.camera.position.clone().sub(this.controls.target).normalize();
    this.flat = flat;
    this.controls.object = this.camera;
    this.frame(height);
    // From far enough away nothing is cut off by the near plane.
    const distance = flat ? 6 * this.ball.radius : height / (2 * Math.tan((FIELD / 2) * (Math.PI / 180)));
    this.camera.position.copy(this.controls.target).addScaledVector(arm, distance);
    this.turned();
  }

  /** After the eye has moved. */
  private turned(): void {
    this.camera.lookAt(this.controls.target);
    this.camera.updateMatrixWorld();
    this.controls.update();
    this.camera.updateMatrixWorld();
    this.refresh();
  }

  /** Looks from a named view, what it shows in sight. */
  look(number: number): void {
    const look = this.data.looks[number];
    if (!look) {
      return;
    }
    this.arrow = look.arrow ?? this.data.arrow;
    const [center, radius] = look.at ? [new Vector3(...look.at[0]), look.at[1]] : [this.ball.center, 0.93 * this.ball.radius];
    const half = (FIELD / 2) * (Math.PI / 180);
    const narrow = Math.min(half, Math.atan(Math.tan(half) * this.aspect));
    // Along an axis sizes are compared: nearer things must not be larger.
    this.flat = look.from.filter((part) => part !== 0).length === 1;
    this.controls.object = this.camera;
    const from = new Vector3(...look.from).normalize();
    if (Math.abs(from.z) > 0.9999) {
      // Straight from above the camera would not know which way is up.
      from.y -= 0.001;
    }
    this.controls.target.copy(center);
    const distance = this.flat ? 6 * this.ball.radius : radius / Math.sin(narrow);
    this.frame((2 * radius) / Math.min(1, this.aspect));
    this.camera.position.copy(from).multiplyScalar(distance).add(center);
    this.turned();
    this.placeAgain();
  }

  /** Where the eye is and what it looks at. */
  get eye(): Eye {
    return { position: this.camera.position.clone(), target: this.controls.target.clone(), flat: this.flat, height: this.height };
  }

  set eye({ position, target, flat = false, height }: Eye) {
    this.flat = flat;
    this.controls.object = this.camera;
    this.controls.target.copy(target);
    this.camera.position.copy(position);
    this.frame(height ?? this.height);
    this.turned();
  }

  /** Turns and moves nearer by keys. */
  orbit(about: number, up: number, nearer: number): void {
    const arm = this.camera.position.clone().sub(this.controls.target);
    const sideways = new Vector3().crossVectors(Z, arm).normalize();
    arm.applyAxisAngle(Z, about);
    const level = Math.asin(arm.z / arm.length());
    arm.applyAxisAngle(sideways, -Math.max(-1.5 - level, Math.min(1.5 - level, up)));
    if (this.flat) {
      this.frame(this.height * nearer);
    } else {
      arm.multiplyScalar(nearer);
    }
    this.camera.position.copy(this.controls.target).add(arm);
    this.turned();
  }

  /** Pixels of the screen for a metre at the target. */
  get pixels(): number {
    return this.canvas.clientHeight / this.height;
  }

  /** Puts everything where it is at an instant. */
  place(at: Instant, factor = this.factor): void {
    this.shown = at;
    for (const { group, pose, spin } of this.moved) {
      const { position, angles } = pose(at, factor, this.data.limit);
      group.position.set(...position);
      group.setRotationFromEuler(turn(angles));
      if (spin) {
        group.rotateY(spin(at));
      }
    }
    if (this.track) {
      for (const { id, group, distance } of this.along) {
        const place = distance(at);
        group.matrix.copy(this.track.frame(place));
        group.matrixWorldNeedsUpdate = true;
        if (id === this.data.follow) {
          this.world.matrixAutoUpdate = false;
          this.world.matrix.copy(group.matrix).invert();
          this.world.matrixWorldNeedsUpdate = true;
          this.track.show(place, factor);
        }
      }
    }
    for (const { group, angles } of this.mounted) {
      group.setRotationFromEuler(turn([factor * angles[0], factor * angles[1], factor * angles[2]]));
    }
    this.scene.updateMatrixWorld();
    for (const { coil, mesh, from, to } of this.sprung) {
      const start = from.localToWorld(new Vector3(...coil.from.point));
      const along = to.localToWorld(new Vector3(...coil.to.point)).sub(start);
      const length = Math.max(along.length(), 1e-3);
      mesh.position.copy(start);
      mesh.quaternion.setFromUnitVectors(Z, along.divideScalar(length));
      mesh.scale.set(1, 1, length);
    }
    const thickness = 0.0214 * this.arrow;
    const longest = this.arrow * this.arrowFactor;
    const length = (force: number, typical = this.scaleForce): number => longest * Math.min(force / typical, LONGEST);
    for (const touch of this.touches) {
      const corner = touch.body.localToWorld(new Vector3(...touch.contact.point));
      const normal = new Vector3(...touch.contact.normal).transformDirection(touch.on.matrixWorld);
      const state = touch.readState(at);
      const pressed = state > 0 ? Math.max(0, touch.readNormal(at)) : 0;
      const size = length(pressed);
      // It pushes: its tip is at the corner.
      touch.normal.show(corner.clone().addScaledVector(normal, -size), normal, size, thickness);
      const friction = new Vector3(...(touch.readFriction.map((read) => read(at)) as [number, number, number]));
      if (touch.axes) {
        friction.applyQuaternion(touch.axes.getWorldQuaternion(new Quaternion()));
      }
      const rubbed = pressed > 0 ? friction.length() : 0;
      touch.friction.show(corner, friction.normalize(), length(rubbed), thickness);
      touch.dot.show(corner.addScaledVector(normal, -0.048 * this.arrow), state);
    }
    for (const patch of this.patches) {
      patch.show(at, (force) => length(force, this.patchForce), thickness);
    }
    for (const mark of this.pressures) {
      mark.show(at);
    }
    this.stale = true;
  }

  /** The same instant, after something else has changed. */
  private placeAgain(): void {
    if (this.shown) {
      this.place(this.shown);
    }
    this.refresh();
  }

  /**
   * Draws if something changed; says whether it did. Without a graphics processor it draws coarsely what moves, and finely
   * what has rested for a moment.
   */
  render(now: number): boolean {
    const { stale } = this;
    if (stale) {
      this.lastDrawn = now;
    } else if (!this.software || this.fine || now - this.lastDrawn < REST) {
      return false;
    }
    this.stale = false;
    if (this.software && this.fine === stale) {
      this.fine = !stale;
      this.renderer.setPixelRatio(this.fine ? 2 : this.density);
    }
    this.renderer.render(this.scene, this.camera);
    return stale;
  }

  /** The contacts whose normal force is seen. */
  get pressed(): string[] {
    const touches = this.touches.filter(({ normal }) => normal.visible).map(({ contact }) => contact.id);
    return [...touches, ...this.patches.filter(({ visible }) => visible).map(({ patch }) => patch.id)];
  }

  /** The contacts' states, 0 open, 1 stick, 2 slip. */
  states(at: Instant): number[] {
    return this.touches.map(({ readState }) => readState(at));
  }

  /** The greatest pressure over each face that has pressures, Pa, by their names. */
  greatestPressures(at: Instant): [string, number][] {
    return this.pressures.map((mark) => [mark.face.name, Math.max(...mark.pressures(at))]);
  }

  /** Where the bodies' origins are drawn, m, by their names. */
  places(): Map<string, Vector3> {
    return new Map(this.moved.map(({ id, group }) => [id, group.getWorldPosition(new Vector3())]));
  }

  /** Directions of the axes on the screen, x to the right and y down. */
  axes(): [number, number][] {
    // Listeners of the controls ask before the next picture is drawn.
    this.camera.updateMatrixWorld();
    const turned = this.camera.matrixWorldInverse;
    return ([[1, 0, 0], [0, 1, 0], [0, 0, 1]] as const).map((axis): [number, number] => {
      const seen = new Vector3(...axis).transformDirection(turned);
      return [seen.x, -seen.y];
    });
  }

  /** Where a place is seen on the canvas, from its upper left corner. */
  project(place: Vector3): [number, number] {
    this.camera.updateMatrixWorld();
    const seen = place.clone().project(this.camera);
    return [((seen.x + 1) / 2) * this.canvas.clientWidth, ((1 - seen.y) / 2) * this.canvas.clientHeight];
  }

  /** Draws once more and gives the picture. */
  picture(take: (blob: Blob) => void): void {
    this.renderer.render(this.scene, this.camera);
    this.canvas.toBlob((blob) => blob && take(blob));
  }

  /** What has a name: solids where they are few, else bodies, each with the place of its name. */
  readonly named: { name: string; place: () => Vector3 }[] = [];

  /** For tests: what is in the scene. */
  get root(): Object3D {
    return this.scene;
  }
}

/** Names of solids where there are few, else of bodies; each with the place where it is written. */
function names(data: SceneData, solids: Map<string, Group>, bodies: Map<string, Group>): { name: string; place: () => Vector3 }[] {
  // Wedges first: where names would cover each other, theirs are written.
  const rank = ({ role }: { role: string }): number => (role === "wedge" ? 0 : 1);
  const own = data.solids.filter(({ name }) => name !== "").sort((a, b) => rank(a) - rank(b));
  if (own.length <= SOLIDS) {
    return own.flatMap(({ id, name }) => {
      const group = solids.get(id);
      const center = group && new Box3().setFromObject(group).getCenter(new Vector3());
      const local = center && group.worldToLocal(center);
      return local ? [{ name, place: () => group.localToWorld(local.clone()) }] : [];
    });
  }
  const first = (id: string): string | undefined => own.find(({ body }) => body === id)?.name;
  const wedges = new Set(own.filter(({ role }) => role === "wedge").map(({ body }) => body));
  const ordered = [...data.bodies].sort((a, b) => Number(wedges.has(b.id)) - Number(wedges.has(a.id)));
  return ordered.flatMap(({ id }) => {
    const [name, group] = [first(id), bodies.get(id)];
    return name !== undefined && group ? [{ name, place: () => group.getWorldPosition(new Vector3()) }] : [];
  });
}

/** A force that few of these exceed, so that most arrows are readable. */
function typicalForce(pressing: { normal_force: string }[], run: RunData): number {
  const forces = pressing
    .flatMap(({ normal_force }) => [...run.values(normal_force)])
    .filter((force) => force > 0)
    .sort((a, b) => a - b);
  return forces[Math.floor(0.9 * forces.length)] ?? 1;
}
