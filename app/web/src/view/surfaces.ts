// Surface materials, their drawing order, and batches of instances.
import * as THREE from 'three';

export const ORDER = { solid: 0, outline: 1, hidden: 5, translucentDepth: 6, translucent: 7 };

// Plain: without gloss, a third of the work of a software renderer.
export type Surface = THREE.MeshStandardMaterial | THREE.MeshLambertMaterial;
export type SurfaceOf = (shininess: number) => Surface;
export const glossy: SurfaceOf = (shininess) =>
  new THREE.MeshStandardMaterial({ roughness: 0.85 - 0.5 * shininess, metalness: 0.05 });
export const plainly: SurfaceOf = () => new THREE.MeshLambertMaterial();

// Depth first, then colour at the nearest surface: the inside of a shell is not visible. Both have a depth
// offset, so that a translucent body at the place of a solid one does not flicker.
export function translucentMaterials(color: Surface, alpha: number) {
  const pushed = { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 4 };
  const depth = new THREE.MeshBasicMaterial({ colorWrite: false, transparent: true, ...pushed });
  color.setValues({ transparent: true, opacity: alpha, depthWrite: false, ...pushed });
  return [
    { material: depth, order: ORDER.translucentDepth, shadow: false },
    { material: color, order: ORDER.translucent, shadow: false },
  ];
}

// Parts behind bodies, drawn over them.
export function hiddenMaterials(color: Surface, alpha: number) {
  color.setValues({
    transparent: true,
    opacity: 0.45 * alpha,
    depthFunc: THREE.GreaterDepth,
    depthWrite: false,
  });
  return [{ material: color, order: ORDER.hidden, shadow: false }];
}

// Back faces of a hull offset by a few pixels at any distance; only its rim is visible.
const WIDER = `
vec3 lengths = vec3(dot(instanceMatrix[0], instanceMatrix[0]),
  dot(instanceMatrix[1], instanceMatrix[1]), dot(instanceMatrix[2], instanceMatrix[2]));
vec3 outward = normalize(mat3(modelViewMatrix) * (mat3(instanceMatrix) * (normal / lengths)));
vec4 mvPosition = modelViewMatrix * instanceMatrix * vec4(transformed, 1.0);
mvPosition.xyz += 0.0035 * -mvPosition.z * outward;
gl_Position = projectionMatrix * mvPosition;`;

export function outlineMaterials() {
  const material = new THREE.MeshBasicMaterial({ side: THREE.BackSide });
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = shader.vertexShader.replace('#include <project_vertex>', WIDER);
  };
  return [{ material, order: ORDER.outline, shadow: false }];
}

// Instances of one mesh with one surface.
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
    this.clear();
    for (const { material } of this.materials) material.dispose();
  }
  private clear(): void {
    this.scene.remove(...this.meshes);
    for (const mesh of this.meshes.splice(0)) mesh.dispose();
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
    this.clear();
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
