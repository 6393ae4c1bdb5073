// A frame of the run: typed-array views into the binary message, not copied.
import type { Vector } from './messages';

// Arrays of a frame in the order of the message, each aligned to 8 bytes: element type, what is counted,
// numbers per item.
const ARRAYS = {
  channels: [Float64Array, 'channels', 1], // NaN: no value at this time
  works: [Float64Array, 'works', 1], // [J]
  // Poses X_WB of the scene's bodies, and of the same links of the target robot (NaN: none):
  // position x y z [m], then quaternion x y z w.
  link: [Float32Array, 'bodies', 7],
  target: [Float32Array, 'bodies', 7],
  position: [Float32Array, 'instances', 3],
  scale: [Float32Array, 'instances', 3],
  turn: [Int16Array, 'instances', 4], // quaternion x y z w in units of 1/32767
  labelPosition: [Float32Array, 'labels', 3],
  labelOffset: [Int16Array, 'labels', 2], // pixels to the right and down
  textEnd: [Uint32Array, 'labels', 1],
  first: [Uint32Array, 'layers and an end', 1], // layer l has the instances first[l] to first[l + 1]
  firstLabel: [Uint32Array, 'layers and an end', 1],
  mesh: [Uint16Array, 'instances', 1],
  body: [Uint16Array, 'instances', 1], // 65535: none
  color: [Uint8Array, 'instances', 4],
  flags: [Uint8Array, 'instances', 1], // 1: faintly visible through bodies
  shininess: [Uint8Array, 'instances', 1],
  texture: [Uint8Array, 'instances', 1], // 0: none
  text: [Uint8Array, 'bytes of text', 1], // of all labels, UTF-8
} as const;
// end of ARRAYS

type Arrays = { -readonly [K in keyof typeof ARRAYS]: InstanceType<(typeof ARRAYS)[K][0]> };

export interface Frame extends Arrays {
  scene: number;
  time: number; // of the run [s]
  stamp: number; // of the newest input that it includes, as the sender set it; 0: none
  number: number; // increases by one per frame
  paused: boolean; // paused
  lookedBack: boolean; // an earlier instant
  layers: number;
  bodies: number;
}

export const NO_BODY = 65535;
const MAGIC = 0x31465754; // "TWF1"
const HEADER = 80;

// Null: not a frame, or truncated. All browsers run on little-endian processors.
export function decodeFrame(buffer: ArrayBuffer): Frame | null {
  if (buffer.byteLength < HEADER) return null;
  const head = new DataView(buffer);
  const u32 = (at: number) => head.getUint32(at, true);
  if (u32(0) !== MAGIC) return null;
  const layers = u32(56);
  const bodies = u32(72);
  const counts = {
    channels: u32(48),
    'works': u32(52),
    'layers and an end': layers + 1,
    instances: u32(60),
    labels: u32(64),
    'bytes of text': u32(68),
    bodies,
  };
  let end = HEADER;
  const arrays = Object.entries(ARRAYS).map(([name, [Kind, of, width]]) => {
    const at = 8 * Math.ceil(end / 8);
    const count = counts[of] * width;
    end = at + count * Kind.BYTES_PER_ELEMENT;
    if (end > buffer.byteLength) return null; // truncated
    return [name, new Kind(buffer, count > 0 ? at : 0, count)];
  });
  if (end > buffer.byteLength) return null;
  const flags = u32(44);
  return {
    ...(Object.fromEntries(arrays as [string, unknown][]) as Arrays),
    scene: u32(4),
    time: head.getFloat64(8, true),
    stamp: head.getFloat64(16, true),
    number: u32(40),
    paused: (flags & 1) !== 0,
    lookedBack: (flags & 2) !== 0,
    layers,
    bodies,
  };
}

const decoder = new TextDecoder();

export function labelText(frame: Frame, label: number): string {
  const begin = label > 0 ? frame.textEnd[label - 1] : 0;
  return decoder.decode(frame.text.subarray(begin, frame.textEnd[label]));
}

// Position of a link; null: not known, or not finite.
export function placeOf(places: Float32Array, body: number): Vector | null {
  const [x, y, z] = places.subarray(7 * body, 7 * body + 3);
  return Number.isFinite(x + y + z) ? [x, y, z] : null;
}
