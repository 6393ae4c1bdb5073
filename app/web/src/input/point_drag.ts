// A point of the world that a pointer leads: in the plane through it that faces the eye; with
// shift up and down alone; the wheel moves the plane nearer or farther. The point does not jump
// when it is taken: it keeps its distance from the pointer.
import * as THREE from 'three';
import type { Stage } from '../view/stage';
import { rayAt } from '../view/pick';

const UP = new THREE.Vector3(0, 0, 1);

export class PointDrag {
  private readonly offset = new THREE.Vector3(); // of the point from where the ray meets the plane
  private vertical = false;
  private x: number;
  private y: number;

  constructor(private readonly stage: Stage, readonly goal: THREE.Vector3, at: { x: number; y: number }) {
    this.x = at.x;
    this.y = at.y;
    this.hold();
  }

  move(at: { x: number; y: number }, vertical: boolean): void {
    if (vertical !== this.vertical) {
      this.vertical = vertical;
      this.hold();
    }
    this.x = at.x;
    this.y = at.y;
    const met = this.meet();
    if (!met) return;
    met.add(this.offset);
    if (this.vertical) this.goal.z = met.z;
    else this.goal.copy(met);
  }

  // Along the line of sight, by a share of the distance.
  deepen(share: number): void {
    const sight = this.goal.clone().sub(this.stage.camera.position);
    this.goal.addScaledVector(sight, share);
    this.hold();
  }

  private hold(): void {
    this.offset.set(0, 0, 0);
    const met = this.meet();
    if (met) this.offset.copy(this.goal).sub(met);
  }

  private meet(): THREE.Vector3 | null {
    const facing = this.stage.camera.getWorldDirection(new THREE.Vector3());
    if (this.vertical) facing.addScaledVector(UP, -facing.dot(UP));
    if (facing.lengthSq() < 1e-3) return null; // from straight above, nothing is up or down
    const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(facing.normalize(), this.goal);
    return rayAt(this.stage, this.x, this.y).intersectPlane(plane, new THREE.Vector3());
  }
}
