import { firstAfter } from '../protocol/run';

// Ring buffer of columns over increasing time; drops the oldest rows when full. Each column is one array with
// space for 25 % more than its capacity; when that is full, the kept rows move to its front.
export class Store {
  length = 0;
  dropped = 0; // rows before row 0
  private readonly space: number;
  private readonly memory: Float64Array[];
  private begin = 0;

  constructor(
    readonly columns: number, // besides the time
    readonly capacity: number, // rows
  ) {
    this.space = capacity + Math.max(1, capacity >> 2);
    this.memory = Array.from({ length: columns + 1 }, () => new Float64Array(this.space));
  }

  get first(): number {
    return this.length > 0 ? this.times[0] : NaN;
  }
  get last(): number {
    return this.length > 0 ? this.memory[0][this.begin + this.length - 1] : NaN;
  }
  // Views are valid until the next row.
  get times(): Float64Array {
    return this.view(0);
  }
  column(index: number): Float64Array {
    return this.view(index + 1);
  }
  value(index: number, row: number): number {
    return this.memory[index + 1][this.begin + row];
  }

  // Setter of a new row, or of the last row if it has this time; null: the time is earlier.
  add(time: number): ((index: number, value: number) => void) | null {
    if (time < this.last) return null;
    if (time > this.last || this.length === 0) {
      this.makeRoom();
      this.length += 1;
    }
    const row = this.begin + this.length - 1;
    this.memory[0][row] = time;
    return (index, value) => {
      this.memory[index + 1][row] = value;
    };
  }

  // The first row later than a time.
  after(time: number): number {
    return firstAfter(this.times, time);
  }

  // Removes rows after a time.
  cut(time: number): void {
    this.length = this.after(time);
  }

  // Copy of the rows after a time.
  copy(from: number): Store {
    const row = Math.max(0, this.after(from) - 1); // one more, so that curves meet
    const count = this.length - row;
    const made = new Store(this.columns, Math.max(1, count));
    made.length = count;
    this.memory.forEach((_, i) => made.memory[i].set(this.view(i).subarray(row)));
    return made;
  }

  private view(index: number): Float64Array {
    return this.memory[index].subarray(this.begin, this.begin + this.length);
  }

  private makeRoom(): void {
    if (this.length === this.capacity) {
      this.begin += 1;
      this.length -= 1;
      this.dropped += 1;
    }
    if (this.begin + this.length < this.space) return;
    for (const column of this.memory) column.copyWithin(0, this.begin, this.begin + this.length);
    this.begin = 0;
  }
}

// Rows [begin, end) in buckets of `stride` rows, a power of two such that there are at most `max` buckets.
// Bucket edges do not move with the window, so that curves do not flicker.
export interface Buckets {
  stride: number;
  edges: number[]; // one more than buckets
}

export function bucketsOf(begin: number, end: number, dropped: number, max: number): Buckets {
  let stride = 1;
  while ((end - begin) / stride > max) stride *= 2;
  const edges: number[] = begin < end ? [begin] : [];
  for (let at = begin + stride - ((begin + dropped) % stride); at < end; at += stride) edges.push(at);
  if (begin < end) edges.push(end);
  return { stride, edges };
}

export type Points = (number | null)[];

// Times of the points of `outline` (pairs) and of `samples`.
export function timesOf(times: Float64Array, buckets: Buckets, pairs: boolean): number[] {
  const { stride, edges } = buckets;
  if (!pairs) return sampled(buckets).map((row) => times[row]);
  const out: number[] = [];
  for (let b = 0; b + 1 < edges.length; ++b) {
    out.push(times[edges[b]]);
    if (stride > 1) out.push(times[edges[b + 1] - 1]);
  }
  return out;
}

// Minimum and maximum of each bucket, in their order of time, so that no peak is lost; NaN: no point.
export function outline(values: Float64Array, { stride, edges }: Buckets): Points {
  const out: Points = [];
  for (let b = 0; b + 1 < edges.length; ++b) {
    let low = -1;
    let high = -1;
    for (let i = edges[b]; i < edges[b + 1]; ++i) {
      if (Number.isNaN(values[i])) continue;
      if (low < 0 || values[i] < values[low]) low = i;
      if (high < 0 || values[i] > values[high]) high = i;
    }
    const at = (i: number) => (i < 0 ? null : values[i]);
    if (stride === 1) out.push(at(low));
    else out.push(at(Math.min(low, high)), at(Math.max(low, high)));
  }
  return out;
}

// First row of each bucket, and the last row: stacked areas need values of one instant.
export function samples(values: Float64Array, buckets: Buckets): Points {
  return sampled(buckets).map((row) => (Number.isNaN(values[row]) ? null : values[row]));
}

function sampled({ stride, edges }: Buckets): number[] {
  const last = stride > 1 ? edges.slice(-1).map((edge) => edge - 1) : [];
  return [...edges.slice(0, -1), ...last];
}
