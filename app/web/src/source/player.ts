// The clock of a replay: what time is shown, and whether it runs.
import type { Clock } from '../panels/time_bar';
import { frameAt, type Run } from '../protocol/run';
import { Playhead } from './playhead';
import { recordOf, type RunRecord } from './run_record';
import type { RunSource } from './run_source';

export class Player extends Playhead implements RunSource, Clock {
  readonly isLive = false;
  readonly hasDiverged = false;
  readonly record: RunRecord;
  readonly times: Float64Array;
  declare at: number;

  constructor(run: Run, private readonly changed: () => void) {
    super(run.times[0]);
    this.record = recordOf(run);
    this.times = run.times;
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
  get speed(): number {
    return this.rate;
  }
  get frame(): number {
    return frameAt(this.times, this.at);
  }
  // Of the way from this frame to the next.
  get share(): number {
    const { frame, times, at } = this;
    if (frame + 1 >= times.length) return 0;
    return Math.min(1, Math.max(0, (at - times[frame]) / (times[frame + 1] - times[frame])));
  }

  // By frames; stops on one.
  step(frames: number): void {
    const here = this.frame;
    const between = this.at > this.times[here] + 1e-9;
    const to = here + frames + (between && frames < 0 ? 1 : 0);
    this.look(this.times[Math.min(this.times.length - 1, Math.max(0, to))]);
  }

  toggle(): void {
    if (!this.playing) return this.play(this.at >= this.end ? this.start : this.at, this.rate, this.end);
    this.pause();
    this.changed();
  }

  setSpeed(speed: number): void {
    this.rate = speed;
    this.changed();
  }

  // Goes on from there, if it was going.
  seek(time: number): void {
    this.put(time);
  }
  // And stays there.
  look(time: number): void {
    super.seek(time);
  }
  seekShare(share: number): void {
    this.look(this.start + share * (this.end - this.start));
  }

  tick(now: number): void {
    this.advance(now, this.end);
  }

  protected put(time: number): void {
    this.at = Math.min(this.end, Math.max(this.start, time));
    this.changed();
  }
}
