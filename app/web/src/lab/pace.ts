// How many pictures a second the page makes: for tests, and for who wonders.
const KEPT = 120;

export class Pace {
  pictures = 0;
  private readonly times: number[] = [];

  painted(now: number): void {
    this.pictures += 1;
    this.times.push(now);
    if (this.times.length > KEPT) this.times.shift();
  }

  // Of the last pictures; 0: too few.
  get rate(): number {
    const span = this.times[this.times.length - 1] - this.times[0];
    return span > 0 ? (1000 * (this.times.length - 1)) / span : 0;
  }
}
