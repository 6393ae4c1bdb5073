// Looking back: which instant is asked for. What is remembered can also be played again, in slow
// motion too; the lab only knows instants, the clock is here.
import type { LabPage } from '../panels/panel';
import { Playhead } from './playhead';

const PAUSE = 33; // between two instants that are asked for [ms]
const SETTLE = 400; // until the lab says what was asked for [ms]

// `at` is as asked for, which is newer than what the lab says.
export class Rewind extends Playhead {
  private startedAt = -Infinity;
  private sentAt = -Infinity;
  private sent: number | null = null;

  constructor(private readonly page: LabPage) {
    super(null);
  }

  // Of the lab's state, unless this page is just choosing.
  follow(at: number | null): void {
    const now = performance.now();
    if (at === null && now - this.startedAt > SETTLE) this.playing = false; // somebody went on
    if (!this.playing && now - this.sentAt > SETTLE) this.at = this.sent = at;
  }

  play(from: number, rate: number, until: number | null = null): void {
    this.startedAt = performance.now();
    super.play(from, rate, until);
  }

  tick(): void {
    this.advance(performance.now(), this.page.state?.last ?? Infinity);
    if (this.at !== this.sent) this.put(this.at);
  }

  protected put(at: number | null): void {
    this.at = at;
    const now = performance.now();
    if (now - this.sentAt < PAUSE && at !== null) return; // with a later tick
    this.sent = at;
    this.sentAt = now;
    this.page.send({ do: 'look', at });
  }
}
