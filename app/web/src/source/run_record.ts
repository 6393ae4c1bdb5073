// Data of the plots, one row per frame; and of the previous branch.
//
// Columns: the scene's channels, the works of its energy balance, their sum; and for each unit of tracking
// errors the maximum over joints and time so far, and the time average of the maximum over joints.
import type { Run } from '../protocol/run';
import type { Frame, SceneMessage, StateMessage } from './link';
import { Store } from './store';

const CAPACITY = 36_000; // frames: ten minutes at 60 Hz
const FRESH = 1000; // [ms]
const BRIDGED = 30; // curves are continuous over fewer missed frames: half a second
const HISTORY_MAGIC = 0x31485754; // "TWH1"
const HISTORY_HEADER = 24;

export type RunHead = Pick<SceneMessage, 'scene' | 'title' | 'channels' | 'energy_balance'>;

export interface ErrorGroup {
  unit: string;
  channels: number[];
  max: number; // columns
  mean: number;
}

export type Gap = [from: number, to: number]; // [s]

type History = NonNullable<ReturnType<typeof decodeHistory>>;

export function decodeHistory(buffer: ArrayBuffer) {
  if (buffer.byteLength < HISTORY_HEADER) return null;
  const [magic, scene, frames, channels, rows] = new Uint32Array(buffer, 0, 5);
  const numbers = frames * (1 + channels + rows);
  if (magic !== HISTORY_MAGIC || buffer.byteLength < HISTORY_HEADER + 8 * numbers) return null;
  const part = (first: number, count: number) => new Float64Array(buffer, HISTORY_HEADER + 8 * first, count);
  return {
    scene,
    times: part(0, frames),
    width: channels, // per frame
    rows, // of the energy balance
    channels: part(frames, frames * channels), // frame by frame
    works: part(frames * (1 + channels), frames * rows),
  };
}

export class RunRecord {
  readonly store: Store;
  before: Store | null = null; // the previous branch, from where this one begins
  readonly errors: ErrorGroup[] = [];
  readonly works: number; // column of the first work
  readonly sum: number;
  version = 0; // changes with the data
  epoch = 0; // changes when time goes back
  lost: number | null = null; // frames after this time were missed
  gaps: Gap[] = []; // where BRIDGED or more frames in a row were missed, ascending
  // Of each column, over all time since it last went back, dropped rows included.
  readonly low: Float64Array;
  readonly high: Float64Array;
  private left: { store: Store; at: number } | null = null;
  private branch = 0;
  private began = NaN;
  private number = NaN; // of the newest frame

  constructor(readonly scene: RunHead, capacity = CAPACITY) {
    const { channels, energy_balance } = scene;
    this.works = channels.length;
    this.sum = this.works + energy_balance.length;
    let next = this.sum + 1;
    const errors = channels.flatMap(({ kind, unit }, i) => (kind === 'error' ? [{ unit, i }] : []));
    for (const unit of new Set(errors.map((error) => error.unit))) {
      const own = errors.filter((error) => error.unit === unit).map(({ i }) => i);
      this.errors.push({ unit, channels: own, max: next, mean: next + 1 });
      next += 2;
    }
    this.store = new Store(next, capacity);
    this.low = new Float64Array(next).fill(Infinity);
    this.high = new Float64Array(next).fill(-Infinity);
  }

  addFrame(frame: Frame): void {
    if (frame.scene !== this.scene.scene || frame.lookedBack) return;
    if (frame.time < this.store.last) this.goBack(frame.time);
    else if (frame.number > this.number + 1) {
      this.lost ??= this.store.last;
      if (frame.number > this.number + BRIDGED) this.gaps.push([this.store.last, frame.time]);
    }
    this.number = frame.number;
    this.addRow(frame.time, frame.channels, frame.works);
  }

  // Replaces the rows of that time span, of which frames were missed.
  addHistory({ scene, times, width: C, rows: R, channels, works }: History): void {
    if (scene !== this.scene.scene || times.length === 0) return;
    const end = times[times.length - 1];
    const later = this.store.last > end ? this.store.copy(end) : null;
    const first = this.store.after(times[0] - 1e-12);
    this.store.cut(first > 0 ? this.store.times[first - 1] : -Infinity);
    if (first === 0) this.began = NaN;
    times.forEach((time, f) =>
      this.addRow(time, channels.subarray(f * C, (f + 1) * C), works.subarray(f * R, (f + 1) * R))
    );
    if (later) this.replay(later, this, end);
    const outside = ([from, to]: Gap): Gap[] => [[from, Math.min(to, times[0])], [Math.max(from, end), to]];
    this.gaps = this.gaps.flatMap(outside).filter(([from, to]) => from < to);
  }

  // The same run with more channels: a contact pair gets its channel at its first contact.
  grownTo(scene: RunHead): RunRecord {
    const made = new RunRecord(scene, this.store.capacity);
    made.replay(this.store, this);
    if (this.before) {
      const left = new RunRecord(scene, Math.max(1, this.before.length));
      left.replay(this.before, this);
      made.before = left.store;
    }
    const { branch, number, began, epoch, gaps } = this;
    Object.assign(made, { branch, number, began, epoch, gaps });
    return made;
  }

  // Copies rows after a time from a store that has the columns of another record.
  private replay(store: Store, of: RunRecord, after = -Infinity): void {
    const places = new Map(of.scene.channels.map(({ name }, i) => [name, i]));
    const channels = this.scene.channels.map(({ name }) => places.get(name) ?? -1); // -1: missing
    const energy_balance = this.scene.energy_balance.map((name) => of.scene.energy_balance.indexOf(name));
    const values = new Float64Array(channels.length);
    const works = new Float64Array(energy_balance.length);
    store.times.forEach((time, row) => {
      if (time <= after) return;
      channels.forEach((from, i) => (values[i] = from < 0 ? NaN : store.value(from, row)));
      energy_balance.forEach((from, i) => (works[i] = from < 0 ? 0 : store.value(of.works + from, row)));
      this.addRow(time, values, works);
    });
  }

  onState({ branch }: StateMessage): void {
    const number = branch?.number ?? 0;
    if (number === this.branch) return;
    this.branch = number;
    this.version += 1;
    this.before = null;
    if (!branch) return;
    // Frames of the new branch may have come before this message.
    const isFresh = this.left && performance.now() - this.left.at < FRESH;
    if (!isFresh && this.store.last > branch.from) this.goBack(branch.from);
    this.before = this.left?.store ?? null;
    this.left = null;
  }

  private goBack(time: number): void {
    this.left = { store: this.store.copy(time), at: performance.now() };
    this.store.cut(time);
    this.epoch += 1;
    if (this.lost !== null && this.lost >= time) this.lost = null;
    this.gaps = this.gaps.filter(([from]) => from < time).map(([from, to]) => [from, Math.min(to, time)]);
    if (this.store.length === 0) this.began = NaN;
    this.low.forEach((_, column) => {
      const known = this.store.column(column).filter((value) => !Number.isNaN(value));
      this.low[column] = known.reduce((min, value) => Math.min(min, value), Infinity);
      this.high[column] = known.reduce((max, value) => Math.max(max, value), -Infinity);
    });
  }

  addRow(time: number, channels: ArrayLike<number>, works: ArrayLike<number>): void {
    const put = this.store.add(time);
    if (!put) return;
    if (Number.isNaN(this.began)) this.began = time;
    const keep = (index: number, value: number) => {
      put(index, value);
      if (value < this.low[index]) this.low[index] = value;
      if (value > this.high[index]) this.high[index] = value;
    };
    // A frame may be older or newer than the scene; new channels are the last.
    for (let i = 0; i < this.works; ++i) keep(i, channels[i] ?? NaN);
    let sum = 0;
    for (let i = this.works; i < this.sum; ++i) {
      const work = works[i - this.works] ?? 0;
      keep(i, work);
      sum += work;
    }
    keep(this.sum, sum);
    for (const group of this.errors) {
      const now = group.channels.reduce((max, i) => Math.max(max, Math.abs(channels[i]) || 0), 0);
      const [max, mean] = this.errorSoFar(group, now, time);
      keep(group.max, max);
      keep(group.mean, mean);
    }
    this.version += 1;
  }

  // Maximum and time average (rectangle rule) up to now, from the previous row.
  private errorSoFar({ max, mean }: ErrorGroup, now: number, time: number): [number, number] {
    const { store, began } = this;
    const row = store.length - 2;
    if (row < 0) return [now, now];
    const then = store.times[row];
    const sum = store.value(mean, row) * (then - began) + now * (time - then);
    return [Math.max(store.value(max, row), now), sum / (time - began)];
  }
}

export function recordOf({ title, channels, energy_balance, times }: Run): RunRecord {
  const { rows, works } = energy_balance;
  const record = new RunRecord({ scene: 0, title, channels, energy_balance: rows }, times.length);
  times.forEach((time, frame) =>
    record.addRow(
      time,
      channels.map(({ values }) => values[frame]),
      works.subarray(frame * rows.length, (frame + 1) * rows.length),
    )
  );
  return record;
}
