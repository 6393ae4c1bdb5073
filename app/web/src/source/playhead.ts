// Instant shown, and its playback: of a recorded run (Player), and of the lab's buffered run (Rewind).
import type { Clock } from '../panels/time_bar';
import { firstAfter, type Run } from '../protocol/run';
import { recordOf } from './run_record';
import type { RunSource } from './run_source';
import type { LabPage } from '../panels/panel';

export class Playhead {
  playing = false;
  speed = 1; // seconds of the run a second
  private until: number | null = null;
  private last = 0; // of the wall clock [ms]

  // `at`: null is the newest.
  constructor(public at: number | null) {}

  // Seeks and pauses.
  look(at: number | null): void {
    this.playing = false;
    this.seek(at);
  }

  // At the end `at` becomes `until`.
  play(from: number, speed: number, until: number | null): void {
    this.playing = true;
    this.speed = speed;
    this.until = until;
    this.last = performance.now();
    this.seek(from);
  }

  advance(now: number, end: number): void {
    if (!this.playing || this.at === null) return;
    const passed = Math.min(0.1, Math.max(0, now - this.last) / 1000); // no jump after a suspended tab
    this.last = now;
    const at = this.at + passed * this.speed;
    this.playing = at < (this.until ?? end);
    this.seek(this.playing ? at : this.until);
  }

  // Keeps playing if it was playing.
  seek(at: number | null): void {
    this.at = at;
  }
}

// Clock of the replay page.
export class Player extends Playhead implements RunSource, Clock {
  readonly isLive = false;
  readonly hasDiverged = false;
  readonly record = recordOf(this.run);
  readonly times = this.run.times;
  declare at: number;

  constructor(private readonly run: Run, private readonly changed: () => void) {
    super(run.times[0]);
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
    return Math.max(0, firstAfter(this.times, this.at + 1e-9) - 1);
  }
  // Interpolation factor between this frame and the next.
  get share(): number {
    const { frame, times, at } = this;
    if (frame + 1 >= times.length) return 0;
    return Math.min(1, Math.max(0, (at - times[frame]) / (times[frame + 1] - times[frame])));
  }

  // Seeks by frames and pauses.
  step(frames: number): void {
    const here = this.frame;
    const between = this.at > this.times[here] + 1e-9;
    const to = here + frames + (between && frames < 0 ? 1 : 0);
    this.look(this.times[Math.min(this.times.length - 1, Math.max(0, to))]);
  }

  toggle(): void {
    if (!this.playing) return this.play(this.at >= this.end ? this.start : this.at, this.speed, this.end);
    this.playing = false;
    this.changed();
  }

  setSpeed(speed: number): void {
    this.speed = speed;
    this.changed();
  }

  seekShare(share: number): void {
    this.look(this.start + share * (this.end - this.start));
  }

  seek(time: number): void {
    this.at = Math.min(this.end, Math.max(this.start, time));
    this.changed();
  }
}

const PAUSE = 33; // between two requests [ms]
const SETTLE = 400; // until the lab's state reflects a request [ms]

// Instant of the buffered run to show. The lab serves single instants; playback runs here. `at` is the
// requested instant, which is newer than the lab's state.
export class Rewind extends Playhead {
  private startedAt = -Infinity;
  private sentAt = -Infinity;
  private sent: number | null = null;

  constructor(private readonly page: LabPage) {
    super(null);
  }

  // Continues from that instant with these changes, and plays.
  branch(at: number, changes: string[]): void {
    this.look(null);
    this.page.send({ do: 'branch', at, changes });
  }

  // Takes the instant of the lab's state, unless a request of this page is pending.
  follow(at: number | null): void {
    const now = performance.now();
    if (at === null && now - this.startedAt > SETTLE) this.playing = false; // another client resumed
    if (!this.playing && now - this.sentAt > SETTLE) this.at = this.sent = at;
  }

  play(from: number, speed: number, until: number | null = null): void {
    this.startedAt = performance.now();
    super.play(from, speed, until);
  }

  tick(): void {
    this.advance(performance.now(), this.page.state?.last ?? Infinity);
    if (this.at !== this.sent) this.seek(this.at);
  }

  seek(at: number | null): void {
    this.at = at;
    const now = performance.now();
    if (now - this.sentAt < PAUSE && at !== null) return; // sent by a later tick
    this.sent = at;
    this.sentAt = now;
    if (this.page.send({ do: 'seek', at })) return;
    this.playing = false; // another client has control
    this.at = this.sent = this.page.state?.at ?? null;
  }
}
