// The clock of a replay: what time is shown, and whether it runs.
import type { Clock } from '../panels/time_bar';
import { frameAt, type Run } from '../protocol/run';
import { recordOf, type RunRecord } from './run_record';
import type { RunSource } from './run_source';

export class Player implements RunSource, Clock {
  readonly isLive = false;
  readonly hasDiverged = false;
  readonly record: RunRecord;
  readonly times: Float64Array;
  time: number;
  playing = false;
  speed = 1;
  private last = 0; // of the wall clock [ms]
  private readonly watchers: (() => void)[] = [];

  constructor(run: Run) {
    this.record = recordOf(run);
    this.times = run.times;
    this.time = this.times[0];
  }

  get at(): number {
    return this.time;
  }
  get stepSize(): number {
    return this.times.length > 1 ? this.times[1] - this.times[0] : 1e-3;
  }

  get start(): number {
    return this.times[0];
  }
  get end(): number {
    return this.times[this.times.length - 1];
  }
  get frame(): number {
    return frameAt(this.times, this.time);
  }
  // Of the way from this frame to the next.
  get share(): number {
    const frame = this.frame;
    if (frame + 1 >= this.times.length) return 0;
    const step = this.times[frame + 1] - this.times[frame];
    return Math.min(1, Math.max(0, (this.time - this.times[frame]) / step));
  }

  watch(watcher: () => void): void {
    this.watchers.push(watcher);
  }

  seek(time: number): void {
    this.time = Math.min(this.end, Math.max(this.start, time));
    this.tell();
  }

  // By frames; stops on one.
  step(frames: number): void {
    this.playing = false;
    const here = this.frame;
    const between = this.time > this.times[here] + 1e-9;
    const to = here + frames + (between && frames < 0 ? 1 : 0);
    this.seek(this.times[Math.min(this.times.length - 1, Math.max(0, to))]);
  }

  toggle(): void {
    this.playing = !this.playing;
    if (this.playing && this.time >= this.end) this.time = this.start;
    this.last = performance.now();
    this.tell();
  }

  setSpeed(speed: number): void {
    this.speed = speed;
    this.tell();
  }

  // And stays there.
  look(time: number): void {
    this.playing = false;
    this.seek(time);
  }
  seekShare(share: number): void {
    this.look(this.start + share * (this.end - this.start));
  }

  tick(now: number): void {
    if (!this.playing) return;
    const passed = Math.min(0.1, (now - this.last) / 1000); // a tab that slept does not jump
    this.last = now;
    this.time += passed * this.speed;
    if (this.time >= this.end) {
      this.time = this.end;
      this.playing = false;
    }
    this.tell();
  }

  private tell(): void {
    for (const watcher of this.watchers) watcher();
  }
}
