// Data embedded in a page: JSON, and one deflated base64 block of arrays, referenced as
// `{"at": byte, "count": n, "type": "f64"}`.
import type { PageData, MeshData } from '../protocol/run';
import { element } from '../ui/dom';

const KINDS = {
  u8: Uint8Array,
  i8: Int8Array,
  u16: Uint16Array,
  i16: Int16Array,
  u32: Uint32Array,
  f32: Float32Array,
  f64: Float64Array,
};

type ArrayPlace = { at: number; count: number; type: keyof typeof KINDS };

function isPlace(value: unknown): value is ArrayPlace {
  return typeof value === 'object' && value !== null && 'at' in value && 'count' in value;
}

async function inflate(base64: string): Promise<ArrayBuffer> {
  const packed = Uint8Array.from(atob(base64.trim()), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Response(stream).arrayBuffer();
}

// Positions are 16-bit fractions of the bounding box, normals bytes, indices differences.
interface PackedMesh extends Pick<MeshData, 'uv' | 'twoSided'> {
  low: [number, number, number];
  high: [number, number, number];
  position: Uint16Array;
  normal: Int8Array;
  index: Int16Array | Uint32Array;
}

function unpackMesh({ low, high, uv, twoSided, ...packed }: PackedMesh): MeshData {
  const place = (share: number, c: number) => low[c] + (share / 65535) * (high[c] - low[c]);
  const position = Float32Array.from(packed.position, (share, i) => place(share, i % 3));
  const normal = Float32Array.from(packed.normal, (n) => n / 127);
  let last = 0; // of unsigned differences, modulo 2^32
  const index = Uint32Array.from(packed.index, (difference) => (last = (last + difference) >>> 0));
  return { position, normal, index, uv, twoSided };
}

const textOf = (id: string): string => document.getElementById(id)?.textContent ?? '';

// Without fetch(), which the page's content security policy forbids.
function picture({ png }: { png: Uint8Array<ArrayBuffer> }): Promise<ImageBitmap> {
  return createImageBitmap(new Blob([png], { type: 'image/png' }));
}

type Packed = { meshes: PackedMesh[]; textures: { png: Uint8Array<ArrayBuffer> }[] };
async function embedded<T extends PageData>(): Promise<T> {
  const buffer = await inflate(textOf('run-bytes'));
  const arrayAt = ({ type, at, count }: ArrayPlace) => new KINDS[type](buffer, at, count);
  const data: Packed = JSON.parse(textOf('run'), (_, value) => (isPlace(value) ? arrayAt(value) : value));
  const textures = await Promise.all(data.textures.map(picture));
  return { ...data, meshes: data.meshes.map(unpackMesh), textures } as unknown as T;
}

// Reads the data and shows it, or the error. The result of `show` is window.twinarm.
export function start<T extends PageData>(show: (data: T) => object): void {
  const begin = async (): Promise<void> => {
    Object.assign(window, { twinarm: show(await embedded<T>()) });
    document.documentElement.dataset.ready = 'true';
  };
  begin().catch((error: unknown) => {
    const reason = error instanceof Error ? error.message : String(error);
    const alert = element('p.failed', { role: 'alert' }, `This page cannot be shown: ${reason}`);
    document.body.replaceChildren(alert);
    console.error(error);
  });
}
