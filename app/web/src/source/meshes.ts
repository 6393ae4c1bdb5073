// Meshes and textures by content hash; each is fetched once.
import type { MeshData } from '../protocol/run';

const TWO_SIDED = 1;
const HAS_UV = 2;
const HEAD = 16; // [bytes]
const NOTHING = decodeMesh(new ArrayBuffer(HEAD));

export function decodeMesh(buffer: ArrayBuffer): MeshData {
  const [vertices, indices, flags] = new Uint32Array(buffer, 0, 3);
  let at = HEAD;
  const floats = (count: number) => {
    const made = new Float32Array(buffer, at, count);
    at += 4 * count;
    return made;
  };
  const position = floats(3 * vertices);
  const normal = floats(3 * vertices);
  const uv = floats(flags & HAS_UV ? 2 * vertices : 0);
  const index = new Uint32Array(buffer, at, indices);
  return { position, normal, index, uv, twoSided: (flags & TWO_SIDED) !== 0 };
}

export class MeshStore {
  private readonly kept = new Map<string, Promise<unknown>>(); // by address

  // One that cannot be fetched is empty; the next scene tries again.
  async get(hashes: string[]): Promise<MeshData[]> {
    const read = async (answer: Response) => decodeMesh(await answer.arrayBuffer());
    return Promise.all(hashes.map((hash) => this.one(`/mesh/${hash}`, read).catch(() => NOTHING)));
  }

  async images(hashes: string[]): Promise<ImageBitmap[]> {
    const read = async (answer: Response) => createImageBitmap(await answer.blob());
    const nothing = () => createImageBitmap(new ImageData(1, 1));
    return Promise.all(hashes.map((hash) => this.one(`/texture/${hash}`, read).catch(nothing)));
  }

  // Forgets those of earlier scenes.
  keepOnly(hashes: string[]): void {
    const needed = new Set(hashes);
    for (const address of this.kept.keys())
      if (!needed.has(address.slice(address.lastIndexOf('/') + 1))) this.kept.delete(address);
  }

  private one<T>(address: string, read: (answer: Response) => Promise<T>): Promise<T> {
    const known = this.kept.get(address);
    if (known) return known as Promise<T>;
    const asked = fetch(address).then((answer) => {
      if (!answer.ok) throw new Error(`${address}: ${answer.status}`);
      return read(answer);
    });
    this.kept.set(address, asked);
    asked.catch(() => this.kept.delete(address));
    return asked;
  }
}
