// One frame of the run, as it came: views into the message, nothing is copied.
import type { Vector } from './messages';

export interface Frame {
  scene: number;
  time: number; // of the run [s]
  stamp: number; // of the newest input in it, as its sender gave it; 0: none
  delay: number; // from when that input came to when the message was made [s]
  step: number;
  number: number; // counts up
  stands: boolean;
  lookedBack: boolean;
  dead: boolean; // the run stopped by itself
  channels: Float64Array; // NaN: has no value now
  works: Float64Array; // by ledger row [J]
  layers: number;
  bodies: number;
  // Where links stand, and those of the kinematic robot (NaN: it has none): x y z, then the turn as
  // a quaternion x y z w, by number of the scene's bodies.
  link: Float32Array;
  twin: Float32Array;
  // Entries of the draw list; layer l has first[l] to first[l + 1].
  first: Uint32Array;
  position: Float32Array;
  scale: Float32Array;
  turn: Int16Array; // quaternion x, y, z, w in units of 1/32767
  mesh: Uint16Array;
  body: Uint16Array; // 65535: none
  color: Uint8Array;
  flags: Uint8Array;
  shininess: Uint8Array;
  texture: Uint8Array;
  // Labels; layer l has firstLabel[l] to firstLabel[l + 1].
  firstLabel: Uint32Array;
  labelPosition: Float32Array;
  labelOffset: Int16Array;
  textEnd: Uint32Array;
  text: Uint8Array; // of all labels, UTF-8
}

export const NO_BODY = 65535;
const MAGIC = 0x31465754; // "TWF1"
const HEADER = 80;

// Hands out the arrays one after the other; each begins at a multiple of 8 bytes.
class Cursor {
  at = HEADER;
  constructor(private readonly buffer: ArrayBuffer) {}

  take<T>(
    kind: { new (buffer: ArrayBuffer, at: number, count: number): T; BYTES_PER_ELEMENT: number },
    count: number,
  ): T {
    // An empty one at the end may begin behind it.
    const made = new kind(this.buffer, count > 0 ? this.at : 0, count);
    this.at = (this.at + kind.BYTES_PER_ELEMENT * count + 7) & ~7;
    return made;
  }
}

// Null: no frame, or one that was cut off. A processor that is not little-endian has no browser.
export function decodeFrame(buffer: ArrayBuffer): Frame | null {
  if (buffer.byteLength < HEADER) return null;
  const head = new DataView(buffer);
  const u32 = (at: number) => head.getUint32(at, true);
  if (u32(0) !== MAGIC) return null;
  const [C, R, L, N, M, B, P] = [48, 52, 56, 60, 64, 68, 72].map(u32);
  const flags = u32(44);
  const arrays = new Cursor(buffer);
  try {
    return {
      scene: u32(4),
      time: head.getFloat64(8, true),
      stamp: head.getFloat64(16, true),
      delay: head.getFloat64(24, true),
      step: Number(head.getBigUint64(32, true)),
      number: u32(40),
      stands: (flags & 1) !== 0,
      lookedBack: (flags & 2) !== 0,
      dead: (flags & 4) !== 0,
      layers: L,
      bodies: P,
      // In the order of the message.
      channels: arrays.take(Float64Array, C),
      works: arrays.take(Float64Array, R),
      link: arrays.take(Float32Array, 7 * P),
      twin: arrays.take(Float32Array, 7 * P),
      position: arrays.take(Float32Array, 3 * N),
      scale: arrays.take(Float32Array, 3 * N),
      turn: arrays.take(Int16Array, 4 * N),
      labelPosition: arrays.take(Float32Array, 3 * M),
      labelOffset: arrays.take(Int16Array, 2 * M),
      textEnd: arrays.take(Uint32Array, M),
      first: arrays.take(Uint32Array, L + 1),
      firstLabel: arrays.take(Uint32Array, L + 1),
      mesh: arrays.take(Uint16Array, N),
      body: arrays.take(Uint16Array, N),
      color: arrays.take(Uint8Array, 4 * N),
      flags: arrays.take(Uint8Array, N),
      shininess: arrays.take(Uint8Array, N),
      texture: arrays.take(Uint8Array, N),
      text: arrays.take(Uint8Array, B),
    };
  } catch (error) {
    if (error instanceof RangeError) return null; // shorter than it says
    throw error;
  }
}

const decoder = new TextDecoder();

export function labelText(frame: Frame, label: number): string {
  const begin = label > 0 ? frame.textEnd[label - 1] : 0;
  return decoder.decode(frame.text.subarray(begin, frame.textEnd[label]));
}

// Where a link stands; null: not known, or not a number.
export function placeOf(places: Float32Array, body: number): Vector | null {
  const [x, y, z] = places.subarray(7 * body, 7 * body + 3);
  return Number.isFinite(x + y + z) ? [x, y, z] : null;
}
