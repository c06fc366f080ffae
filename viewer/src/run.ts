// A run on the page: the 3D view and plots on one clock.

import type { Vector3 } from "three";

import { Clock, SPEEDS } from "./clock.js";
import type { RunData } from "./data.js";
import { element, icon, select } from "./dom.js";
import { keyboard } from "./keyboard.js";
import { LoopPlot } from "./plots/loop-plot.js";
import { RunPlot, type Shown } from "./plots/run-plot.js";
import type { Range } from "./plots/curves.js";
import { FRICTION, NORMAL, STATES } from "./scene/arrows.js";
import { ELLIPSE } from "./scene/patch.js";
import { RAMP_STYLE } from "./scene/pressure.js";
import { LONGEST, SceneView, type Eye } from "./scene/view.js";
import { fileName, save } from "./save.js";
import { Names } from "./scene/names.js";
import { Store } from "./store.js";
import { digits, type Units } from "./units.js";

export const FACTORS = [1, 2, 5, 10, 20, 50];
/** How many plots over time there are, and how many beside a loop. */
const PLOTS = [3, 2] as const;
/** At most this many names are shown at first. */
const FEW = 8;
const PLAY = "M3 1v14l11-7z";
const PAUSE = "M3 1h3.5v14H3zM9.5 1H13v14H9.5z";
const START = "M2 1h2.5v14H2zM14 1v14L5 8z";
const FILL = "M1 1h5v2H3v3H1zM10 1h5v5h-2V3h-3zM1 10h2v3h3v2H1zM13 10h2v5h-5v-2h3z";

/** What a reader chose, for the view of the next run. */
export interface Chosen {
  time: number;
  playing: boolean;
  speed: number;
  loop: boolean;
  /** The part of the time that plots show; all of it if it is missing. */
  window: Range | undefined;
  plots: Shown[];
  eye: Eye | undefined;
  factor: number | undefined;
  arrows: number | undefined;
  filled: boolean;
  focused: boolean;
}

export class RunView {
  readonly root = element("div", { class: "wl-run", tabindex: "0", role: "group" });
  readonly clock: Clock;
  private readonly window: Store<Range>;
  private readonly plots: RunPlot[];
  private readonly loop: LoopPlot | undefined;
  /** The run that is drawn beside this one. */
  private readonly other = new Store<RunData | undefined>(undefined);
  private readonly names = new Names();
  private readonly flatButton: HTMLButtonElement;
  private readonly namesButton: HTMLButtonElement;
  private readonly scene: SceneView | undefined;
  private readonly stage = element("div", { class: "wl-stage" });
  private readonly told = element("p", { class: "wl-told" });
  private readonly key = element("div", { class: "wl-key" });
  private readonly bar = element("span", { class: "wl-bar" });
  private readonly barText = element("span");
  private readonly pressureText = element("span");
  private readonly triad = element("div", { class: "wl-triad", "aria-hidden": "true" });
  private readonly playButton: HTMLButtonElement;
  private readonly scrubber: HTMLInputElement;
  private readonly timeText = element("output", { class: "wl-time" });
  private readonly speedList: HTMLSelectElement;
  private readonly loopBox: HTMLInputElement;
  private readonly unitsButton: HTMLButtonElement;
  private readonly factorList: HTMLSelectElement;
  private readonly stops: (() => void)[] = [];
  private readonly observer: ResizeObserver;
  private request = 0;
  private frames: number[] = [];

  constructor(
    private readonly run: RunData,
    private readonly units: Store<Units>,
    private readonly switchUnits: () => void,
    private readonly before?: Chosen,
    others: RunData[] = [],
  ) {
    this.clock = new Clock(run.start, run.end);
    const [from, to] = before?.window ?? [run.start, run.end];
    this.window = new Store<Range>(from < run.end ? [from, Math.min(to, run.end)] : [run.start, run.end]);
    if (before) {
      this.clock.speed = before.speed;
      this.clock.loop = before.loop;
      this.clock.set(before.time);
    }
    this.root.setAttribute("aria-label", `Animation and plots of ${run.run.name}`);
    const button = (text: string | Node, label: string, act: () => void): HTMLButtonElement =>
      element("button", { type: "button", "aria-label": label, title: label, onclick: act }, text);
    this.playButton = button("", "play or pause (space)", () => this.clock.play());
    this.scrubber = element("input", {
      type: "range",
      class: "wl-scrubber",
      "aria-label": "time",
      min: run.start,
      max: run.end,
      step: "any",
      value: run.start,
      oninput: () => {
        // Stopping the clock moves the scrubber back to its time.
        const time = Number(this.scrubber.value);
        this.clock.play(false);
        this.clock.set(time);
      },
    });
    this.speedList = select(
      { "aria-label": "speed", title: "speed (− and +)" },
      SPEEDS.map((speed) => [String(speed), `${speed}× speed`]),
      "1",
      (speed) => this.clock.setSpeed(Number(speed)),
    );
    this.loopBox = element("input", { type: "checkbox", checked: true, onchange: () => this.clock.setLoop(this.loopBox.checked) });

    this.scene = this.make();
    if (this.scene && before) {
      this.scene.factor = before.factor ?? this.scene.factor;
      this.scene.arrowFactor = before.arrows ?? this.scene.arrowFactor;
    }
    const first = this.scene?.factor ?? 1;
    const factors = [...new Set([...FACTORS, first])].sort((a, b) => a - b);
    this.factorList = select(
      { "aria-label": "exaggeration", title: "exaggeration of small displacements (E, Shift+E)" },
      factors.map((factor) => [String(factor), factor === 1 ? "to scale" : `exaggerated ${factor}×`]),
      String(first),
      (factor) => this.exaggerate(Number(factor)),
    );
    const arrows = select(
      { "aria-label": "length of arrows" },
      [0, 0.5, 1, 2, 4].map((factor) => [String(factor), factor === 0 ? "no arrows" : `arrows ${factor}×`]),
      String(this.scene?.arrowFactor ?? 1),
      (factor) => {
        if (this.scene) {
          this.scene.arrowFactor = Number(factor);
          this.show();
        }
      },
    );
    this.flatButton = button("parallel", "perspective or parallel projection (O)", () => this.flatten());
    this.namesButton = button("names", "names of the bodies (N)", () => this.nameBodies());
    const picture = button("PNG", "save this view as a picture (PNG)", () => this.savePicture());
    const beside = select(
      { "aria-label": "run drawn beside this one" },
      [["", "no run beside"], ...others.map(({ run: own }, k): [string, string] => [String(k), `beside: ${own.name}`])],
      "",
      (chosen) => this.other.set(chosen === "" ? undefined : others[Number(chosen)]),
    );
    const views = (run.run.scene?.looks ?? []).map(({ name }, k) => button(name, `view: ${name} (${k + 1})`, () => this.scene?.look(k)));
    this.unitsButton = button("", "inch-pound or SI (U)", this.switchUnits);
    const fill = button(icon(FILL), "fill the window (F)", () => this.fill());
    this.root.append(
      element(
        "div",
        { class: "wl-controls" },
        button(icon(START), "to the start (Home)", () => this.clock.set(run.start)),
        this.playButton,
        this.scrubber,
        this.timeText,
        this.speedList,
        element("label", {}, this.loopBox, " loop"),
        this.unitsButton,
        ...(others.length > 0 ? [beside] : []),
        fill,
      ),
    );
    const stage = element("div", { class: "wl-scene" }, this.stage);
    if (this.scene) {
      stage.prepend(this.told);
      stage.append(this.key, element("div", { class: "wl-views" }, ...views, this.flatButton, this.namesButton, picture, this.factorList, arrows));
      this.stage.append(this.names.root);
      this.names.shown = this.scene.named.length <= FEW;
    }
    const loops = run.run.loops ?? [];
    this.plots = Array.from({ length: PLOTS[loops.length > 0 ? 1 : 0] }, (_, k) => k)
      .filter((k) => k < run.run.plots.length)
      .map((k) => new RunPlot(run, this.clock, units, this.window, k, before?.plots[k], this.other));
    this.loop = loops.length > 0 ? new LoopPlot(run, this.clock, units, loops, this.other) : undefined;
    const plots = element("div", { class: "wl-plots" }, ...(this.loop ? [this.loop.root] : []), ...this.plots.map((plot) => plot.root));
    this.root.append(
      element("div", { class: "wl-columns" }, stage, plots),
      help(),
    );

    this.stops.push(
      this.clock.watch(() => this.show()),
      units.watch(() => this.show()),
      keyboard(this.root, this),
    );
    this.show();
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(this.stage);
    const frame = (now: number): void => {
      this.request = requestAnimationFrame(frame);
      this.clock.frame(now);
      if (this.scene?.render(now)) {
        this.drawn(now);
      }
    };
    this.request = requestAnimationFrame(frame);
    if (before?.playing) {
      this.clock.play(true);
    }
  }

  /** After it was put into the page: as large as the one before, and with the keys. */
  takePlace(): void {
    if (this.before?.filled) {
      this.fill(true);
    } else if (this.before?.focused) {
      this.root.focus({ preventScroll: true });
    }
  }

  /** What the reader chose so far. */
  get chosen(): Chosen {
    const { clock, run, scene } = this;
    const [from, to] = this.window.value;
    return {
      time: clock.time,
      playing: clock.playing,
      speed: clock.speed,
      loop: clock.loop,
      window: from === run.start && to === run.end ? undefined : [from, to],
      plots: this.plots.map(({ shown }) => shown),
      eye: this.root.dataset.ready ? scene?.eye : this.before?.eye,
      factor: scene?.factor,
      arrows: scene?.arrowFactor,
      filled: this.root.classList.contains("wl-filled"),
      focused: this.root.contains(document.activeElement),
    };
  }

  dispose(): void {
    cancelAnimationFrame(this.request);
    this.observer.disconnect();
    for (const stop of this.stops) {
      stop();
    }
    for (const plot of this.plots) {
      plot.dispose();
    }
    this.loop?.dispose();
    this.scene?.dispose();
    this.root.remove();
  }

  // What keys do.

  step(rows: number): void {
    const { times } = this.run;
    const at = this.run.at(this.clock.time);
    const row = at.row + (at.share > 0.999 ? 1 : at.share > 0.001 && rows < 0 ? 1 : 0) + rows;
    this.clock.play(false);
    this.clock.set(times[Math.min(times.length - 1, Math.max(0, row))] ?? 0);
  }

  look(number: number): void {
    this.scene?.look(number);
  }

  orbit(about: number, up: number, nearer: number): void {
    this.scene?.orbit(about, up, nearer);
  }

  flatten(): void {
    if (this.scene) {
      this.scene.flatten(!this.scene.flat);
      this.show();
    }
  }

  nameBodies(): void {
    this.names.shown = !this.names.shown;
    this.show();
  }

  /** Saves the view as it is seen, without names and key. */
  private savePicture(): void {
    this.scene?.picture((blob) => save(blob, fileName(`${this.run.run.name} at ${this.clock.time.toFixed(2)} s`, "png")));
  }

  changeFactor(by: 1 | -1): void {
    const options = [...this.factorList.options].map((option) => Number(option.value));
    const place = options.indexOf(this.scene?.factor ?? 1) + by;
    const factor = options[Math.min(options.length - 1, Math.max(0, place))] ?? 1;
    this.factorList.value = String(factor);
    this.exaggerate(factor);
  }

  nextUnits(): void {
    this.switchUnits();
  }

  /** Fills the window, or no longer. */
  fill(on = !this.root.classList.contains("wl-filled")): void {
    this.root.classList.toggle("wl-filled", on);
    document.documentElement.classList.toggle("wl-covered", on);
    this.root.focus({ preventScroll: true });
  }

  private exaggerate(factor: number): void {
    if (this.scene) {
      this.scene.factor = factor;
      this.show();
    }
  }

  private make(): SceneView | undefined {
    const data = this.run.run.scene;
    if (!data) {
      this.stage.append(element("p", { class: "wl-lacks" }, "This run has no 3D view."));
      return undefined;
    }
    let scene: SceneView;
    try {
      scene = new SceneView(data, this.run);
    } catch (error) {
      const why = error instanceof Error ? error.message : String(error);
      this.stage.append(element("p", { class: "wl-lacks" }, `The 3D view needs WebGL, which this browser does not give: ${why}`));
      return undefined;
    }
    scene.canvas.setAttribute("role", "img");
    scene.canvas.setAttribute("aria-label", `What moves in ${this.run.run.name}, with the forces of its contacts`);
    const colour = (text: string, style: string, shape: string): HTMLElement => {
      const mark = element("i", { class: shape });
      mark.style.background = style;
      return element("span", {}, mark, text);
    };
    // Without contacts and patches there are no arrows to explain.
    if (data.contacts.length > 0 || data.patches) {
      this.key.append(
        element("span", {}, this.bar, this.barText),
        colour("normal force", NORMAL, "wl-stroke"),
        ...(data.contacts.length > 0
          ? [colour("friction", FRICTION, "wl-stroke"), ...STATES.map(([name, style]) => colour(name, style, "wl-dot"))]
          : [colour("creep force", FRICTION, "wl-stroke"), colour("contact patch", ELLIPSE, "wl-dot")]),
      );
    }
    if (scene.scalePressure !== undefined) {
      const colours = element("i", { class: "wl-ramp" });
      colours.style.background = RAMP_STYLE;
      this.key.append(element("span", {}, "pressure: 0 ", colours, this.pressureText));
      this.pressureText.title = "Greater pressures have the same colour.";
    }
    this.barText.title = `Arrows longer than ${LONGEST} times this bar are cut.`;
    this.stage.append(scene.canvas, this.triad);
    scene.controls.addEventListener("change", () => this.show());
    // The wheel scrolls the page until the view is clicked or Ctrl is held.
    scene.canvas.addEventListener(
      "wheel",
      (event) => {
        scene.controls.enableZoom = event.ctrlKey || this.root.contains(document.activeElement);
      },
      { capture: true, passive: true },
    );
    scene.canvas.addEventListener(
      "pointerdown",
      () => {
        // Two fingers zoom whatever the wheel does.
        scene.controls.enableZoom = true;
        this.root.focus({ preventScroll: true });
      },
      { capture: true },
    );
    return scene;
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.stage;
    if (!this.scene || width === 0 || height === 0) {
      return;
    }
    const first = !this.root.dataset.ready;
    this.scene.resize(width, height, devicePixelRatio);
    if (first) {
      if (this.before?.eye) {
        this.scene.eye = this.before.eye;
      } else {
        this.scene.look(0);
      }
      this.root.dataset.ready = "yes";
    }
    this.show();
  }

  /** Shows the clock's time. */
  private show(): void {
    const { clock, scene, run } = this;
    const { time, playing } = clock;
    const state = this.root.dataset;
    if (state.playing !== String(playing)) {
      this.playButton.replaceChildren(icon(playing ? PAUSE : PLAY));
      this.frames = [];
    }
    this.scrubber.value = String(time);
    this.scrubber.setAttribute("aria-valuetext", `${time.toFixed(2)} s`);
    this.timeText.textContent = `${time.toFixed(2)} s`;
    this.speedList.value = String(clock.speed);
    this.loopBox.checked = clock.loop;
    this.unitsButton.textContent = this.units.value.system === "us" ? "in, lbf" : "m, N";
    state.time = time.toFixed(4);
    state.playing = String(playing);
    state.units = this.units.value.system;
    if (!scene) {
      return;
    }
    const at = run.at(time);
    scene.place(at);
    this.overlay();
    state.factor = String(scene.factor);
    state.visibleArrows = scene.pressed.join(" ");
    state.states = scene.states(at).join(" ");
    state.pressures = JSON.stringify(Object.fromEntries(scene.greatestPressures(at)));
    const places = [...scene.places()];
    const told = (digits: number, of: (place: Vector3) => number[]): string =>
      JSON.stringify(Object.fromEntries(places.map(([id, place]) => [id, of(place).map((x) => Number(x.toFixed(digits)))])));
    state.eye = JSON.stringify(scene.eye.position.toArray().map((x) => Number(x.toFixed(5))));
    state.flat = String(scene.flat);
    this.flatButton.setAttribute("aria-pressed", String(scene.flat));
    this.namesButton.setAttribute("aria-pressed", String(this.names.shown));
    this.names.place(scene.named.map(({ name, place }) => ({ name, at: scene.project(place()) })), this.stage.clientWidth, this.stage.clientHeight);
    state.places = told(7, (place) => place.toArray());
    state.pixels = told(1, (place) => scene.project(place));
  }

  /** The texts over the picture. */
  private overlay(): void {
    const { scene } = this;
    if (!scene) {
      return;
    }
    const units = this.units.value;
    const { limit } = this.run.run.scene ?? { limit: 0 };
    this.told.textContent =
      scene.factor === 1
        ? "To scale."
        : `Angles and gaps ${scene.factor}× exaggerated (gaps to ${(limit * units.factor("length")).toPrecision(2)} ${units.label("length")} as drawn, beyond that to scale); travel to scale.`;
    const shown = round(scene.scaleForce * units.factor("force"));
    const metres = (scene.arrow * scene.arrowFactor * shown) / (scene.scaleForce * units.factor("force"));
    this.bar.style.width = `${Math.min(200, metres * scene.pixels).toFixed(0)}px`;
    this.bar.hidden = scene.arrowFactor === 0;
    const label = units.label("force");
    const wheels = ((scene.patchForce ?? 0) * shown) / scene.scaleForce;
    const text = scene.patchForce === undefined ? ` ${digits(shown)} ${label}` : ` ${digits(shown)} ${label} at wedges, ${digits(wheels)} ${label} at wheels`;
    this.barText.textContent = scene.arrowFactor === 0 ? "" : text;
    if (scene.scalePressure !== undefined) {
      this.pressureText.textContent = ` ${units.text(scene.scalePressure, "pressure")} and more`;
    }
    this.triad.replaceChildren(triad(scene.axes()));
  }

  /** Counts frames drawn in the last two seconds of playing. */
  private drawn(now: number): void {
    if (!this.clock.playing) {
      return;
    }
    this.frames.push(now);
    while ((this.frames[0] ?? now) < now - 2000) {
      this.frames.shift();
    }
    const span = now - (this.frames[0] ?? now);
    if (span > 500) {
      this.root.dataset.frameRate = ((1000 * (this.frames.length - 1)) / span).toFixed(1);
    }
  }
}

/** The nearest number below with one digit 1, 2 or 5. */
function round(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  return ([5, 2, 1].find((digit) => digit * power <= value) ?? 1) * power;
}

function triad(axes: [number, number][]): SVGSVGElement {
  const space = "http://www.w3.org/2000/svg";
  const picture = document.createElementNS(space, "svg");
  picture.setAttribute("viewBox", "-32 -32 64 64");
  ["x", "y", "z"].forEach((name, k) => {
    const [x, y] = axes[k] ?? [0, 0];
    const line = document.createElementNS(space, "line");
    line.setAttribute("x2", String(20 * x));
    line.setAttribute("y2", String(20 * y));
    const text = document.createElementNS(space, "text");
    text.setAttribute("x", String(27 * x));
    text.setAttribute("y", String(27 * y + 4));
    text.textContent = name;
    if (Math.hypot(x, y) > 0.15) {
      picture.append(line, text);
    }
  });
  return picture;
}

function help(): HTMLElement {
  const row = (keys: string, what: string): HTMLElement =>
    element("li", {}, element("kbd", {}, keys), ` ${what}`);
  return element(
    "details",
    { class: "wl-help" },
    element("summary", {}, "Mouse and keys"),
    element(
      "ul",
      {},
      row("drag", "orbits the 3D view; with the right button or two fingers it pans"),
      row("wheel", "zooms the 3D view or the time axis once it was clicked, or with Ctrl"),
      row("two fingers", "zoom the 3D view and the plots"),
      row("drag in a plot", "moves the time; a double click shows the whole run"),
      row("space", "play, pause"),
      row("← →", "one output time back or on; with Shift ten"),
      row("Home End", "start, end"),
      row("− +", "slower, faster"),
      row("L", "loop"),
      row("1, 2, …", "named views"),
      row("W A S D", "orbit; with Shift nearer and farther (W, S)"),
      row("E, Shift+E", "more, less exaggeration"),
      row("O", "perspective or parallel projection"),
      row("N", "names of the bodies"),
      row("U", "inch-pound or SI"),
      row("F, Esc", "fill the window, leave it"),
    ),
  );
}
