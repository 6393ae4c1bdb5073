// The run as the plots remember it: channels, ledger, and what is made of them, frame by frame; and
// the branch that was left.
//
// Columns: the scene's channels, its ledger rows, the ledger's sum, and for each unit of the errors
// the largest of any joint so far and the mean over time of the largest of each instant.
import type { Frame, SceneMessage, StateMessage } from './link';
import { Store } from './store';

const MOST = 36_000; // frames: ten minutes at sixty a second
const FRESH = 1000; // [ms]
const HISTORY_MAGIC = 0x31485754; // "TWH1"
const HISTORY_HEADER = 24;

export interface ErrorGroup {
  unit: string;
  channels: number[];
  most: number; // columns
  mean: number;
}

export interface History {
  scene: number;
  times: Float64Array;
  channels: Float64Array; // frame by frame
  works: Float64Array;
}

export function decodeHistory(buffer: ArrayBuffer): History | null {
  if (buffer.byteLength < HISTORY_HEADER) return null;
  const head = new Uint32Array(buffer, 0, 5);
  const [magic, scene, frames, channels, rows] = head;
  const numbers = frames * (1 + channels + rows);
  if (magic !== HISTORY_MAGIC || buffer.byteLength < HISTORY_HEADER + 8 * numbers) return null;
  const part = (first: number, count: number) =>
    new Float64Array(buffer, HISTORY_HEADER + 8 * first, count);
  return {
    scene,
    times: part(0, frames),
    channels: part(frames, frames * channels),
    works: part(frames * (1 + channels), frames * rows),
  };
}

export class RunRecord {
  readonly store: Store;
  before: Store | null = null; // of the branch that was left, from where it was left
  readonly errors: ErrorGroup[] = [];
  readonly works: number; // column of the first ledger row
  readonly sum: number;
  version = 0; // changes with what is remembered
  epoch = 0; // changes when time went back
  lost: number | null = null; // frames later than this were not seen by the page
  // Of each column, all that was ever there.
  readonly low: Float64Array;
  readonly high: Float64Array;
  private left: { store: Store; at: number } | null = null;
  private branch = 0;
  private began = NaN;
  private number = NaN; // of the newest frame

  constructor(
    readonly scene: SceneMessage,
    most = MOST,
  ) {
    const { channels, ledger } = scene;
    this.works = channels.length;
    this.sum = this.works + ledger.length;
    let next = this.sum + 1;
    const kinds = channels.map((channel, i) => ({ ...channel, i }));
    const errors = kinds.filter((channel) => channel.kind === 'error');
    for (const unit of new Set(errors.map((channel) => channel.unit))) {
      const own = errors.filter((channel) => channel.unit === unit).map((channel) => channel.i);
      this.errors.push({ unit, channels: own, most: next, mean: next + 1 });
      next += 2;
    }
    this.store = new Store(next, most);
    this.low = new Float64Array(next).fill(Infinity);
    this.high = new Float64Array(next).fill(-Infinity);
  }

  addFrame(frame: Frame): void {
    if (frame.scene !== this.scene.scene || frame.lookedBack) return;
    if (frame.time < this.store.last) this.goBack(frame.time);
    else if (frame.number > this.number + 1 && this.lost === null) this.lost = this.store.last;
    this.number = frame.number;
    this.addRow(frame.time, frame.channels, frame.works);
  }

  // What the page has not seen, or missed: takes the place of what is remembered of that time.
  addHistory({ scene, times, channels, works }: History): void {
    if (scene !== this.scene.scene || times.length === 0) return;
    const C = this.scene.channels.length;
    const R = this.scene.ledger.length;
    const end = times[times.length - 1];
    const later = this.store.last > end ? this.store.copy(end) : null;
    const first = this.store.after(times[0] - 1e-12);
    this.store.cut(first > 0 ? this.store.times[first - 1] : -Infinity);
    times.forEach((time, f) =>
      this.addRow(time, channels.subarray(f * C, (f + 1) * C), works.subarray(f * R, (f + 1) * R)),
    );
    if (!later) return;
    const row = new Float64Array(C + R);
    later.times.forEach((time, f) => {
      if (time <= end) return;
      row.forEach((_, i) => (row[i] = later.value(i, f)));
      this.addRow(time, row.subarray(0, C), row.subarray(C));
    });
  }

  onState({ branch }: StateMessage): void {
    const number = branch?.number ?? 0;
    if (number === this.branch) return;
    this.branch = number;
    this.version += 1;
    this.before = null;
    if (!branch) return;
    // The frames may have gone back before this message came.
    const isFresh = this.left && performance.now() - this.left.at < FRESH;
    if (!isFresh && this.store.last > branch.from) this.goBack(branch.from);
    this.before = this.left?.store ?? null;
    this.left = null;
  }

  private goBack(time: number): void {
    this.left = { store: this.store.copy(time), at: performance.now() };
    this.store.cut(time);
    this.epoch += 1;
    this.lost = null;
    if (this.store.length === 0) this.began = NaN;
  }

  private addRow(time: number, channels: Float64Array, works: Float64Array): void {
    const put = this.store.add(time);
    if (!put) return;
    if (Number.isNaN(this.began)) this.began = time;
    const keep = (index: number, value: number) => {
      put(index, value);
      if (value < this.low[index]) this.low[index] = value;
      if (value > this.high[index]) this.high[index] = value;
    };
    channels.forEach((value, i) => keep(i, value));
    let sum = 0;
    works.forEach((value, i) => {
      keep(this.works + i, value);
      sum += value;
    });
    keep(this.sum, sum);
    const previous = this.store.length - 2;
    for (const group of this.errors) this.follow(group, channels, time, previous, keep);
    this.version += 1;
  }

  // The largest so far, and the mean over time by the rectangle rule, from the row before.
  private follow(
    { channels, most, mean }: ErrorGroup,
    values: Float64Array,
    time: number,
    previous: number,
    keep: (index: number, value: number) => void,
  ): void {
    let now = 0;
    for (const i of channels) now = Math.max(now, Math.abs(values[i]) || 0);
    if (previous < 0) {
      keep(most, now);
      keep(mean, now);
      return;
    }
    const then = this.store.times[previous];
    const passed = then - this.began;
    const all = time - this.began;
    keep(most, Math.max(this.store.value(most, previous), now));
    keep(mean, (this.store.value(mean, previous) * passed + now * (time - then)) / all);
  }
}
