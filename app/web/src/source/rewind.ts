// Looking back: which instant is asked for. What is remembered can also be played again, in slow
// motion too; the lab only knows instants, the clock is here.
import type { LabPage } from '../panels/panel';

const PAUSE = 33; // between two instants that are asked for [ms]
const SETTLE = 400; // until the lab says what was asked for [ms]

export class Rewind {
  playing = false;
  at: number | null = null; // as asked for, which is newer than what the lab says; null: the newest
  private rate = 1;
  private until: number | null = null; // null: to the newest
  private last = 0; // of the wall clock [ms]
  private startedAt = -Infinity;
  private sentAt = -Infinity;
  private sent: number | null = null;

  constructor(private readonly page: LabPage) {}

  // Of the lab's state, unless this page is just choosing.
  follow(at: number | null): void {
    const now = performance.now();
    if (at === null && now - this.startedAt > SETTLE) this.playing = false; // somebody went on
    if (!this.playing && now - this.sentAt > SETTLE) this.at = this.sent = at;
  }

  seek(at: number | null): void {
    this.playing = false;
    this.ask(at);
  }

  // From an instant on, at so many seconds of the run a second.
  play(from: number, rate: number, until: number | null = null): void {
    this.playing = true;
    this.rate = rate;
    this.until = until;
    this.last = this.startedAt = performance.now();
    this.ask(from);
  }

  pause(): void {
    this.playing = false;
  }

  tick(): void {
    const now = performance.now();
    if (this.playing && this.at !== null) {
      const end = this.until ?? this.page.state?.last ?? this.at;
      this.at += this.rate * Math.min(0.1, (now - this.last) / 1000);
      this.last = now;
      if (this.at >= end) {
        this.playing = false;
        this.at = this.until;
      }
    }
    if (this.at !== this.sent && now - this.sentAt >= PAUSE) this.ask(this.at);
  }

  private ask(at: number | null): void {
    this.at = at;
    if (performance.now() - this.sentAt < PAUSE && at !== null) return; // with the next tick
    this.sent = at;
    this.sentAt = performance.now();
    this.page.send({ do: 'look', at });
  }
}
