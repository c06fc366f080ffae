// The time that plots and scene of a run share.

export const SPEEDS = [0.02, 0.05, 0.1, 0.25, 0.5, 1, 2, 4];

export class Clock {
  private current: number;
  private running = false;
  private lastFrame: number | undefined;
  private readonly watchers = new Set<() => void>();
  speed = 1;
  loop = true;

  constructor(
    readonly start: number,
    readonly end: number,
  ) {
    this.current = start;
  }

  get time(): number {
    return this.current;
  }

  get playing(): boolean {
    return this.running;
  }

  set(time: number): void {
    this.current = Math.min(this.end, Math.max(this.start, time));
    this.tell();
  }

  play(on = !this.running): void {
    if (on && !this.loop && this.current >= this.end) {
      this.current = this.start;
    }
    this.running = on;
    this.lastFrame = undefined;
    this.tell();
  }

  setSpeed(speed: number): void {
    this.speed = speed;
    this.tell();
  }

  setLoop(loop: boolean): void {
    this.loop = loop;
    this.tell();
  }

  /** The next speed of the list, up or down. */
  changeSpeed(by: 1 | -1): void {
    const place = SPEEDS.indexOf(this.speed) + by;
    this.setSpeed(SPEEDS[Math.min(SPEEDS.length - 1, Math.max(0, place))] ?? 1);
  }

  /** Goes on by the time since the last call, `now` in milliseconds. */
  frame(now: number): void {
    const before = this.lastFrame;
    this.lastFrame = now;
    if (!this.running || before === undefined) {
      return;
    }
    const span = this.end - this.start;
    let next = this.current + (this.speed * (now - before)) / 1000;
    if (next >= this.end) {
      if (this.loop && span > 0) {
        next = this.start + ((next - this.start) % span);
      } else {
        next = this.end;
        this.running = false;
      }
    }
    this.current = next;
    this.tell();
  }

  watch(watcher: () => void): () => void {
    this.watchers.add(watcher);
    return () => this.watchers.delete(watcher);
  }

  private tell(): void {
    for (const watcher of this.watchers) {
      watcher();
    }
  }
}
