// Meshes and textures by the hash of what they are: each is fetched once, and never again.
import type { MeshData } from '../protocol/run';

const TWO_SIDED = 1;
const HAS_UV = 2;
const NOTHING: MeshData = {
  position: new Float32Array(),
  normal: new Float32Array(),
  index: new Uint32Array(),
  uv: new Float32Array(),
  twoSided: false,
};

export function decodeMesh(buffer: ArrayBuffer): MeshData {
  const [vertices, indices, flags] = new Uint32Array(buffer, 0, 3);
  let at = 16;
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

async function fetched(address: string): Promise<Response> {
  const answer = await fetch(address);
  if (!answer.ok) throw new Error(`${address}: ${answer.status}`);
  return answer;
}

export class MeshStore {
  private readonly meshes = new Map<string, Promise<MeshData>>();
  private readonly textures = new Map<string, Promise<ImageBitmap>>();

  // One that cannot be had is empty, and asked for again by the next scene.
  async get(hashes: string[]): Promise<MeshData[]> {
    const parts = hashes.map((hash) =>
      kept(this.meshes, hash, async () =>
        decodeMesh(await (await fetched(`/mesh/${hash}`)).arrayBuffer()),
      ).catch(() => NOTHING),
    );
    return Promise.all(parts);
  }

  async images(hashes: string[]): Promise<ImageBitmap[]> {
    const parts = hashes.map((hash) =>
      kept(this.textures, hash, async () =>
        createImageBitmap(await (await fetched(`/texture/${hash}`)).blob()),
      ).catch(() => createImageBitmap(new ImageData(1, 1))),
    );
    return Promise.all(parts);
  }
}

function kept<T>(store: Map<string, Promise<T>>, hash: string, get: () => Promise<T>): Promise<T> {
  const known = store.get(hash);
  if (known) return known;
  const asked = get();
  store.set(hash, asked);
  asked.catch(() => store.delete(hash));
  return asked;
}
