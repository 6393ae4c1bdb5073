// Arrows that the page adds to the view: forces on the inspected body.
import * as THREE from 'three';
import type { Vector } from '../protocol/messages';

export interface Arrow {
  from: Vector;
  along: Vector; // world axes, metres
  color: string;
}

const UP = new THREE.Vector3(0, 1, 0); // the axis of three's cylinders and cones

export class Arrows {
  private readonly group = new THREE.Group();
  private readonly shaft = new THREE.CylinderGeometry(1, 1, 1, 16).translate(0, 0.5, 0);
  private readonly head = new THREE.ConeGeometry(1, 1, 20).translate(0, 0.5, 0);

  constructor(scene: THREE.Scene, private readonly thickness: number) {
    scene.add(this.group);
  }

  // Replaces all arrows. Drawn over bodies, since most begin inside one.
  set(arrows: Arrow[]): void {
    for (const mesh of this.group.children as THREE.Mesh<THREE.BufferGeometry, THREE.Material>[])
      mesh.material.dispose();
    this.group.clear();
    for (const arrow of arrows) this.add(arrow);
  }

  remove(): void {
    this.set([]);
    this.group.removeFromParent();
    this.shaft.dispose();
    this.head.dispose();
  }

  private add({ from, along, color }: Arrow): void {
    const direction = new THREE.Vector3(...along);
    const length = direction.length();
    if (!(length > 0)) return;
    direction.divideScalar(length);
    const head = Math.min(6.5 * this.thickness, 0.6 * length);
    const start = new THREE.Vector3(...from);
    const neck = start.clone().addScaledVector(direction, length - head);
    const put = (geometry: THREE.BufferGeometry, at: THREE.Vector3, radius: number, size: number) => {
      const material = new THREE.MeshBasicMaterial({ color, depthTest: false, transparent: true });
      const mesh = new THREE.Mesh(geometry, material);
      mesh.position.copy(at);
      mesh.quaternion.setFromUnitVectors(UP, direction);
      mesh.scale.set(radius, size, radius);
      mesh.renderOrder = 20;
      this.group.add(mesh);
    };
    put(this.shaft, start, this.thickness, length - head);
    put(this.head, neck, 2.4 * this.thickness, head);
  }
}
