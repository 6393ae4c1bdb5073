// Draws a draw list with three.js: entries with the same mesh and surface form one instanced mesh.
import * as THREE from 'three';
import type { InstanceColumns, MeshData } from '../protocol/run';
import { Batch, translucentMaterials, hiddenMaterials, ORDER, outlineMaterials, type SurfaceOf } from './surfaces';

// Frames a and b of one layer, interpolated by `share`. A live frame has layers in the place of frames.
export interface Part {
  columns: InstanceColumns;
  a: number;
  b: number;
  share: number;
  alpha?: number; // 0 to 255, overrides that of the entries
  shadow?: boolean; // casts shadows
  // Draws only an outline, of the entries for which `of` is true.
  outline?: { color: THREE.ColorRepresentation; of: (entry: number) => boolean };
}

const SEEN_THROUGH = 1;
// Kinds of entries: with shadow, without, drawn over what hides it, translucent, outline.
const [BODY, SOLID, HIDDEN, TRANSLUCENT, OUTLINE] = [0, 1, 2, 3, 4];
const KINDS = 5;

function geometryOf(mesh: MeshData): THREE.BufferGeometry {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(mesh.position, 3));
  geometry.setAttribute('normal', new THREE.BufferAttribute(mesh.normal, 3));
  geometry.setIndex(new THREE.BufferAttribute(mesh.index, 1));
  if (mesh.uv.length > 0) geometry.setAttribute('uv', new THREE.BufferAttribute(mesh.uv, 2));
  return geometry;
}

// Rows run downwards, as in an ImageBitmap.
function textureOf(image: ImageBitmap): THREE.Texture {
  const texture = new THREE.Texture(image);
  texture.flipY = false;
  texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.anisotropy = 4;
  texture.needsUpdate = true;
  return texture;
}

// A coarse sphere in place of a unit sphere: contact points cover few pixels, but there may be a hundred.
function coarser(mesh: MeshData, fine: THREE.BufferGeometry): THREE.BufferGeometry {
  const p = mesh.position;
  if (mesh.index.length < 3 * 500) return fine;
  for (let i = 0; i < p.length; i += 3)
    if (Math.abs(Math.hypot(p[i], p[i + 1], p[i + 2]) - 1) > 1e-3) return fine; // not a unit sphere
  return new THREE.SphereGeometry(1, 14, 9);
}

// Common properties of the entries of a batch.
interface Look {
  mesh: number;
  isSmall: boolean; // drawn coarsely
  alpha: number;
  shininess: number;
  kind: number;
  texture: number; // as in the columns
}

export class Pose {
  readonly position = new THREE.Vector3();
  readonly turn = new THREE.Quaternion();
  readonly scale = new THREE.Vector3();

  read({ position, turn, scale }: Pick<InstanceColumns, 'position' | 'turn' | 'scale'>, i: number): this {
    this.position.fromArray(position, 3 * i);
    this.turn.fromArray(turn, 4 * i).normalize();
    this.scale.fromArray(scale, 3 * i);
    return this;
  }
  goTowards(other: Pose, share: number): void {
    this.position.lerp(other.position, share);
    this.turn.slerp(other.turn, share);
    this.scale.lerp(other.scale, share);
  }
  compose(matrix: THREE.Matrix4): void {
    matrix.compose(this.position, this.turn, this.scale);
  }
}

export class Painter {
  readonly geometries: THREE.BufferGeometry[] = []; // by mesh
  private readonly coarse: THREE.BufferGeometry[] = [];
  private readonly meshes: MeshData[] = [];
  readonly textures: THREE.Texture[] = [];
  private readonly batches = new Map<number, Batch>();
  private readonly matrix = new THREE.Matrix4();
  private readonly pose = new Pose();
  private readonly otherPose = new Pose();
  private readonly color = new THREE.Color();

  constructor(
    private readonly scene: THREE.Scene,
    private readonly small: number, // entries up to this size are drawn coarsely
    private readonly surface: SurfaceOf,
  ) {}

  // Appends.
  add(meshes: MeshData[], textures: ImageBitmap[]): void {
    for (const mesh of meshes) {
      const fine = geometryOf(mesh);
      this.meshes.push(mesh);
      this.geometries.push(fine);
      this.coarse.push(coarser(mesh, fine));
    }
    this.textures.push(...textures.map(textureOf));
  }

  // Frees all GPU memory.
  remove(): void {
    for (const batch of this.batches.values()) batch.remove();
    for (const made of [...this.geometries, ...this.coarse, ...this.textures]) made.dispose();
    this.batches.clear();
  }

  paint(parts: Part[]): void {
    for (const batch of this.batches.values()) batch.count = 0;
    for (const part of parts) this.addPart(part);
    for (const batch of this.batches.values()) batch.finish();
  }

  private addPart({ columns, a, b, share, alpha, shadow, outline }: Part): void {
    const from = columns.first[a];
    const to = columns.first[a + 1];
    const other = columns.first[b];
    // Interpolated only if both frames have the same entries.
    let between = share > 0 && columns.first[b + 1] - other === to - from;
    for (let i = 0; between && i < to - from; ++i)
      between = columns.mesh[from + i] === columns.mesh[other + i];
    for (let i = from; i < to; ++i) {
      if (outline && !outline.of(i)) continue;
      this.pose.read(columns, i);
      if (between) this.pose.goTowards(this.otherPose.read(columns, other + i - from), share);
      this.pose.compose(this.matrix);
      if (outline) {
        this.putOutline(columns.mesh[i], outline.color);
        continue;
      }
      const [red, green, blue] = columns.color.subarray(4 * i, 4 * i + 3);
      this.color.setRGB(red / 255, green / 255, blue / 255, THREE.SRGBColorSpace);
      this.put(columns, i, alpha ?? columns.color[4 * i + 3], shadow ?? false);
    }
  }

  private put(columns: InstanceColumns, i: number, alpha: number, shadow: boolean): void {
    const { x, y, z } = this.pose.scale;
    const isSmall = Math.max(x, y, z) < this.small;
    const mesh = columns.mesh[i];
    if (mesh >= this.meshes.length) return; // not loaded yet
    const shininess = columns.shininess[i];
    const kind = alpha < 255 ? TRANSLUCENT : shadow ? BODY : SOLID;
    const texture = alpha < 255 ? 0 : columns.texture[i];
    const look = { mesh, isSmall, alpha, shininess, kind, texture };
    this.batch(look).add(this.matrix, this.color);
    if (columns.flags[i] & SEEN_THROUGH)
      this.batch({ ...look, kind: HIDDEN, texture: 0 }).add(this.matrix, this.color);
  }

  private putOutline(mesh: number, color: THREE.ColorRepresentation): void {
    if (mesh >= this.meshes.length) return;
    const look = { mesh, isSmall: false, alpha: 255, shininess: 0, kind: OUTLINE, texture: 0 };
    this.batch(look).add(this.matrix, this.color.set(color));
  }

  private batch(look: Look): Batch {
    const { mesh, isSmall, alpha, shininess, kind, texture } = look;
    const size = isSmall ? 1 : 0;
    const surface = ((2 * mesh + size) * 256 + alpha) * 256 + shininess;
    const key = (surface * 256 + texture) * KINDS + kind;
    let batch = this.batches.get(key);
    if (!batch) {
      const materials = this.materialsOf(look);
      const geometry = (isSmall ? this.coarse : this.geometries)[mesh];
      batch = new Batch(this.scene, geometry, materials);
      this.batches.set(key, batch);
    }
    return batch;
  }

  private materialsOf({ mesh, alpha, shininess, kind, texture }: Look) {
    if (kind === OUTLINE) return outlineMaterials();
    const surface = this.surface(shininess / 255);
    if (kind === HIDDEN) return hiddenMaterials(surface, alpha / 255);
    if (kind === TRANSLUCENT) return translucentMaterials(surface, alpha / 255);
    const { uv, twoSided } = this.meshes[mesh];
    surface.map = texture > 0 && uv.length > 0 ? (this.textures[texture - 1] ?? null) : null;
    if (twoSided) surface.side = THREE.DoubleSide;
    return [{ material: surface, order: ORDER.solid, shadow: kind === BODY }];
  }
}
