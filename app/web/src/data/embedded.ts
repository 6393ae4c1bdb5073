// What a page carries: a text of JSON, and one block of bytes to which it points, deflated
// and in base64. `{"at": byte, "count": n, "type": "f64"}` stands for an array.
import type { MeshData } from './run';

type Bytes = Uint8Array | Uint16Array | Uint32Array | Int16Array | Float32Array | Float64Array;

interface ArrayPlace {
  at: number;
  count: number;
  type: 'u8' | 'u16' | 'u32' | 'i8' | 'i16' | 'f32' | 'f64';
}

function isPlace(value: unknown): value is ArrayPlace {
  return typeof value === 'object' && value !== null && 'at' in value && 'count' in value;
}

function arrayAt(buffer: ArrayBuffer, place: ArrayPlace): Bytes | Int8Array {
  const { at, count } = place;
  switch (place.type) {
    case 'u8':
      return new Uint8Array(buffer, at, count);
    case 'i8':
      return new Int8Array(buffer, at, count);
    case 'u16':
      return new Uint16Array(buffer, at, count);
    case 'i16':
      return new Int16Array(buffer, at, count);
    case 'u32':
      return new Uint32Array(buffer, at, count);
    case 'f32':
      return new Float32Array(buffer, at, count);
    case 'f64':
      return new Float64Array(buffer, at, count);
  }
}

// Puts arrays in the place of what points to them, all the way down.
function resolve(value: unknown, buffer: ArrayBuffer): unknown {
  if (isPlace(value)) return arrayAt(buffer, value);
  if (Array.isArray(value)) return value.map((item) => resolve(item, buffer));
  if (typeof value !== 'object' || value === null) return value;
  return Object.fromEntries(
    Object.entries(value).map(([key, item]) => [key, resolve(item, buffer)]),
  );
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
