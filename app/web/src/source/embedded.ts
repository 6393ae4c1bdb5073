// What a page carries: a text of JSON, and one block of bytes to which it points, deflated
// and in base64. `{"at": byte, "count": n, "type": "f64"}` stands for an array.
import type { MeshData } from '../protocol/run';
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

interface ArrayPlace {
  at: number;
  count: number;
  type: keyof typeof KINDS;
}

function isPlace(value: unknown): value is ArrayPlace {
  return typeof value === 'object' && value !== null && 'at' in value && 'count' in value;
}

// Puts arrays in the place of what points to them, all the way down.
function resolve(value: unknown, buffer: ArrayBuffer): unknown {
  if (isPlace(value)) return new KINDS[value.type](buffer, value.at, value.count);
  if (Array.isArray(value)) return value.map((item) => resolve(item, buffer));
  if (typeof value !== 'object' || value === null) return value;
  return Object.fromEntries(Object.entries(value).map(([key, item]) => [key, resolve(item, buffer)]));
}

async function inflate(base64: string): Promise<ArrayBuffer> {
  const packed = Uint8Array.from(atob(base64.trim()), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Response(stream).arrayBuffer();
}

// Positions come as 16-bit shares of the mesh's box, normals as bytes, indices as differences.
interface PackedMesh {
  low: [number, number, number];
  high: [number, number, number];
  position: Uint16Array;
  normal: Int8Array;
  index: Int16Array | Uint32Array;
  uv: Float32Array;
  twoSided: boolean;
}

function unpackMesh(packed: PackedMesh): MeshData {
  const position = new Float32Array(packed.position.length);
  for (let i = 0; i < position.length; ++i) {
    const c = i % 3;
    position[i] =
      packed.low[c] + (packed.position[i] / 65535) * (packed.high[c] - packed.low[c]);
  }
  const normal = Float32Array.from(packed.normal, (n) => n / 127);
  const index = new Uint32Array(packed.index.length);
  let last = 0;
  for (let i = 0; i < index.length; ++i) {
    last = (last + packed.index[i]) >>> 0; // of unsigned differences, modulo 2^32
    index[i] = last;
  }
  return { position, normal, index, uv: packed.uv, twoSided: packed.twoSided };
}

function textOf(id: string): string {
  return document.getElementById(id)?.textContent ?? '';
}

// No fetch: a page may load nothing, not even from itself.
function picture({ png }: { png: Uint8Array<ArrayBuffer> }): Promise<ImageBitmap> {
  return createImageBitmap(new Blob([png], { type: 'image/png' }));
}

// A Run, or whatever else has meshes. The program that wrote the page vouches for its shape.
export async function embedded<
  T extends { meshes: MeshData[]; textures: ImageBitmap[] },
>(): Promise<T> {
  const plain: unknown = JSON.parse(textOf('run'));
  const data = resolve(plain, await inflate(textOf('run-bytes'))) as object & {
    meshes: PackedMesh[];
    textures: { png: Uint8Array<ArrayBuffer> }[];
  };
  const textures = await Promise.all(data.textures.map(picture));
  return { ...data, meshes: data.meshes.map(unpackMesh), textures } as unknown as T;
}

// How a page begins: what it carries is read and shown, or the page says why it cannot be.
// `show` gives what tests and the curious find as window.twinarm.
export function start<T extends { meshes: MeshData[]; textures: ImageBitmap[] }>(
  show: (data: T) => object,
): void {
  const begin = async (): Promise<void> => {
    Object.assign(window, { twinarm: show(await embedded<T>()) });
    document.documentElement.dataset.ready = 'true';
  };
  begin().catch((error: unknown) => {
    const words = error instanceof Error ? error.message : String(error);
    const text = `This page cannot be shown: ${words}`;
    document.body.replaceChildren(element('p.failed', { role: 'alert' }, text));
    console.error(error);
  });
}
