import * as THREE from 'three';
import { ORDER } from './materials';

// Instances of one mesh and one surface.
export class Batch {
  readonly meshes: THREE.InstancedMesh[] = [];
  count = 0;
  private capacity = 0;

  constructor(
    private readonly scene: THREE.Scene,
    private readonly geometry: THREE.BufferGeometry,
    private readonly materials: { material: THREE.Material; order: number; shadow: boolean }[],
  ) {}

  add(matrix: THREE.Matrix4, color: THREE.Color): void {
    if (this.count === this.capacity) this.grow();
    matrix.toArray(this.meshes[0].instanceMatrix.array, 16 * this.count);
    color.toArray(this.meshes[0].instanceColor!.array, 3 * this.count);
    this.count += 1;
  }

  remove(): void {
    for (const mesh of this.meshes) {
      this.scene.remove(mesh);
      mesh.dispose();
    }
    for (const { material } of this.materials) material.dispose();
  }

  finish(): void {
    for (const mesh of this.meshes) {
      mesh.count = this.count;
      mesh.visible = this.count > 0;
      mesh.instanceMatrix.needsUpdate = true;
      mesh.instanceColor!.needsUpdate = true;
    }
  }

  // All materials share matrices and colours.
  private grow(): void {
    const before = this.meshes[0];
    this.capacity = Math.max(4, 2 * this.capacity);
    const matrices = new THREE.InstancedBufferAttribute(new Float32Array(16 * this.capacity), 16);
    const colors = new THREE.InstancedBufferAttribute(new Float32Array(3 * this.capacity), 3);
    if (before) {
      matrices.array.set(before.instanceMatrix.array);
      colors.array.set(before.instanceColor!.array);
    }
    for (const mesh of this.meshes) {
      this.scene.remove(mesh);
      mesh.dispose();
    }
    this.meshes.length = 0;
    for (const { material, order, shadow } of this.materials) {
      const mesh = new THREE.InstancedMesh(this.geometry, material, this.capacity);
      mesh.instanceMatrix = matrices;
      mesh.instanceColor = colors;
      mesh.frustumCulled = false;
      mesh.castShadow = shadow;
      mesh.receiveShadow = order === ORDER.solid;
      mesh.renderOrder = order;
      this.scene.add(mesh);
      this.meshes.push(mesh);
    }
  }
}
