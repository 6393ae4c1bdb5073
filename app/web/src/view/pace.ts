// How many pictures a second the page makes; and when that is too few for what comes.
const KEPT = 60;
const ENOUGH = 24; // a second

export class Pace {
  pictures = 0;
  private times: number[] = [];

  // True: pictures were too few for a while, though there was more to show.
  painted(now: number): boolean {
    this.pictures += 1;
    const last = this.times[this.times.length - 1];
    if (now - last > 1000) this.times = []; // it stood, or nobody looked
    this.times.push(now);
    if (this.times.length <= KEPT) return false;
    this.times.shift();
    if (this.rate > ENOUGH) return false;
    this.times = [];
    return true;
  }

  // Of the last pictures; 0: too few.
  get rate(): number {
    const span = this.times[this.times.length - 1] - this.times[0];
    return span > 0 ? (1000 * (this.times.length - 1)) / span : 0;
  }
}
