// A draw list painted by three.js: entries with the same mesh and surface are one instanced mesh.
// A live frame is a part too: its columns, with layers in the place of frames.
import * as THREE from 'three';
import type { InstanceColumns, MeshData } from '../protocol/run';
import {
  Batch, ghostMaterials, hiddenMaterials, ORDER, outlineMaterials, solidMaterial, type SurfaceOf,
} from './surfaces';

// Frames a and b of one layer, and how far between the two.
export interface Part {
  columns: InstanceColumns;
  a: number;
  b: number;
  share: number;
  alpha?: number; // 0 to 255, in the place of that of the entries
  shadow?: boolean; // whether its entries throw one
  // Instead of the entries a line around those that are meant, in this colour.
  outline?: { color: THREE.ColorRepresentation; of: (entry: number) => boolean };
}

const SEEN_THROUGH = 1;
// How an entry is drawn: with a shadow, without, over what hides it, translucent, as a line around.
const [BODY, SOLID, HIDDEN, GHOST, OUTLINE] = [0, 1, 2, 3, 4];
const KINDS = 5;

function geometryOf(mesh: MeshData): THREE.BufferGeometry {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(mesh.position, 3));
  geometry.setAttribute('normal', new THREE.BufferAttribute(mesh.normal, 3));
  geometry.setIndex(new THREE.BufferAttribute(mesh.index, 1));
  if (mesh.uv.length > 0) geometry.setAttribute('uv', new THREE.BufferAttribute(mesh.uv, 2));
  return geometry;
}

// Rows run down, as they do in an ImageBitmap; a place outside wraps round.
function textureOf(image: ImageBitmap): THREE.Texture {
  const texture = new THREE.Texture(image);
  texture.flipY = false;
  texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.anisotropy = 4;
  texture.needsUpdate = true;
  return texture;
}

// A point of a contact is a ball of few pixels: a hundred of them would cost as much as all robots.
function coarser(mesh: MeshData, fine: THREE.BufferGeometry): THREE.BufferGeometry {
  const p = mesh.position;
  if (mesh.index.length < 3 * 500) return fine;
  for (let i = 0; i < p.length; i += 3)
    if (Math.abs(Math.hypot(p[i], p[i + 1], p[i + 2]) - 1) > 1e-3) return fine; // no unit ball
  return new THREE.SphereGeometry(1, 14, 9);
}

// What entries have in common that one batch draws.
interface Look {
  mesh: number;
  isSmall: boolean; // drawn coarsely
  alpha: number;
  shininess: number;
  kind: number;
  texture: number; // as in the columns
}

// Where an entry stands.
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
  private readonly textures: THREE.Texture[] = [];
  private readonly batches = new Map<number, Batch>();
  private readonly matrix = new THREE.Matrix4();
  private readonly pose = new Pose();
  private readonly otherPose = new Pose();
  private readonly color = new THREE.Color();

  constructor(
    private readonly scene: THREE.Scene,
    private readonly small: number, // size of what is drawn coarsely
    private readonly surface: SurfaceOf,
  ) {}

  // Behind those that it has.
  add(meshes: MeshData[], textures: ImageBitmap[]): void {
    for (const mesh of meshes) {
      const fine = geometryOf(mesh);
      this.meshes.push(mesh);
      this.geometries.push(fine);
      this.coarse.push(coarser(mesh, fine));
    }
    this.textures.push(...textures.map(textureOf));
  }

  // Nothing of it stays, in the scene or in the graphics card.
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
    // Between two frames only where both have the same entries.
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
    if (mesh >= this.meshes.length) return; // it has not come yet
    const shininess = columns.shininess[i];
    const kind = alpha < 255 ? GHOST : shadow ? BODY : SOLID;
    // A ghost shows no texture.
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
    if (kind === GHOST) return ghostMaterials(surface, alpha / 255);
    const { uv, twoSided } = this.meshes[mesh];
    const map = texture > 0 && uv.length > 0 ? (this.textures[texture - 1] ?? null) : null;
    const material = solidMaterial(surface, map, twoSided);
    return [{ material, order: ORDER.solid, shadow: kind === BODY }];
  }
}
