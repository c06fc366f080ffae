// A value that others watch.

export class Store<T> {
  private readonly watchers = new Set<(value: T) => void>();

  constructor(private current: T) {}

  get value(): T {
    return this.current;
  }

  set(value: T): void {
    if (value === this.current) {
      return;
    }
    this.current = value;
    for (const watcher of [...this.watchers]) {
      watcher(value);
    }
  }

  /** Calls now and at every change; the result ends it. */
  watch(watcher: (value: T) => void): () => void {
    this.watchers.add(watcher);
    watcher(this.current);
    return () => this.watchers.delete(watcher);
  }
}
