// The instant that is shown, and whether it moves on by itself: of a recorded run (player.ts), and of
// what a lab remembers (rewind.ts).
export class Playhead {
  playing = false;
  protected rate = 1; // seconds of the run a second
  private until: number | null = null;
  private last = 0; // of the wall clock [ms]

  // `at`: null is the newest.
  constructor(public at: number | null) {}

  seek(at: number | null): void {
    this.playing = false;
    this.put(at);
  }

  // From an instant on; at the end of what there is it stands at `until`.
  play(from: number, rate: number, until: number | null): void {
    this.playing = true;
    this.rate = rate;
    this.until = until;
    this.last = performance.now();
    this.put(from);
  }

  pause(): void {
    this.playing = false;
  }

  // `end`: of what there is.
  advance(now: number, end: number): void {
    if (!this.playing || this.at === null) return;
    const passed = Math.min(0.1, Math.max(0, now - this.last) / 1000); // a tab that slept does not jump
    this.last = now;
    const at = this.at + passed * this.rate;
    this.playing = at < (this.until ?? end);
    this.put(this.playing ? at : this.until);
  }

  protected put(at: number | null): void {
    this.at = at;
  }
}
