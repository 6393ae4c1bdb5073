// What the plots remember: columns of numbers over time, the oldest dropped when they are full, so
// that hours cost what minutes cost. Time rises from row to row.
//
// Each column lies in one piece of memory with room for a quarter more than is kept; when that is
// full, what is kept moves to the front: a copy every quarter, nothing per row.
export class Store {
  length = 0;
  dropped = 0; // rows that were there before row 0
  private readonly room: number;
  private readonly memory: Float64Array[];
  private begin = 0;

  constructor(
    readonly columns: number, // besides the time
    readonly most: number, // rows
  ) {
    this.room = most + Math.max(1, most >> 2);
    this.memory = Array.from({ length: columns + 1 }, () => new Float64Array(this.room));
  }

  get first(): number {
    return this.length > 0 ? this.times[0] : NaN;
  }
  get last(): number {
    return this.length > 0 ? this.memory[0][this.begin + this.length - 1] : NaN;
  }
  // Views that hold until the next row.
  get times(): Float64Array {
    return this.view(0);
  }
  column(index: number): Float64Array {
    return this.view(index + 1);
  }
  value(index: number, row: number): number {
    return this.memory[index + 1][this.begin + row];
  }

  // Fills the row that was added, or that already stands at this time. Earlier: refused.
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
    const times = this.times;
    let low = 0;
    let high = this.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (times[middle] <= time) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  // Forgets all that is later.
  cut(time: number): void {
    this.length = this.after(time);
  }

  // Another one with the rows later than a time, that does not change with this one.
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
    if (this.length === this.most) {
      this.begin += 1;
      this.length -= 1;
      this.dropped += 1;
    }
    if (this.begin + this.length < this.room) return;
    for (const column of this.memory)
      column.copyWithin(0, this.begin, this.begin + this.length);
    this.begin = 0;
  }
}

// Rows [begin, end) in buckets of `stride`, which stand where they stand however the window moves
// (a curve does not shiver): the smallest power of two that leaves at most `most` buckets.
export interface Buckets {
  stride: number;
  edges: number[]; // one more than buckets
}

export function bucketsOf(begin: number, end: number, dropped: number, most: number): Buckets {
  let stride = 1;
  while ((end - begin) / stride > most) stride *= 2;
  const edges: number[] = begin < end ? [begin] : [];
  for (let at = begin + stride - ((begin + dropped) % stride); at < end; at += stride)
    edges.push(at);
  if (begin < end) edges.push(end);
  return { stride, edges };
}

export type Points = (number | null)[];

// Times of the points that `outline` (two a bucket) and `samples` give.
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

// Two points a bucket, the least and the largest value in the order in which they came: no peak
// is lost. NaN has no point.
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

// One point a bucket, its first, and the very last: of areas upon each other, which must be of one
// instant.
export function samples(values: Float64Array, buckets: Buckets): Points {
  return sampled(buckets).map((row) => (Number.isNaN(values[row]) ? null : values[row]));
}

function sampled({ stride, edges }: Buckets): number[] {
  const last = stride > 1 ? edges.slice(-1).map((edge) => edge - 1) : [];
  return [...edges.slice(0, -1), ...last];
}
