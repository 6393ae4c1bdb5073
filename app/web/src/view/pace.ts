// Frame rate of the page, and whether it is too low.
const KEPT = 60;
const ENOUGH = 24; // [Hz]

export class Pace {
  pictures = 0;
  private times: number[] = [];

  // True: the rate over the last pictures was too low.
  painted(now: number): boolean {
    this.pictures += 1;
    const last = this.times[this.times.length - 1];
    if (now - last > 1000) this.times = []; // paused, or the page was hidden
    this.times.push(now);
    if (this.times.length <= KEPT) return false;
    this.times.shift();
    if (this.rate > ENOUGH) return false;
    this.times = [];
    return true;
  }

  // [Hz]; 0: too few pictures to tell.
  get rate(): number {
    const span = this.times[this.times.length - 1] - this.times[0];
    return span > 0 ? (1000 * (this.times.length - 1)) / span : 0;
  }
}
