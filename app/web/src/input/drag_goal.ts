// Goal of a drag: a point in a plane, or the angle of a joint.
import * as THREE from 'three';
import type { Pixel, Stage } from '../view/stage';
import { within } from '../ui/scale';
import { rayAt } from '../view/pick';

const UP = new THREE.Vector3(0, 0, 1);

const MIN_SINE = 0.25; // of a view's angle to a plane in which the pointer is met

// A point moved in a plane through it: the one in which its joints can move it, else the one that faces the
// camera; with shift vertically only; the wheel moves it along the line of sight. The offset between point and
// pointer is kept. In a plane seen nearly edge-on, pointer up is away from the eye.
export class PointDrag {
  private readonly offset = new THREE.Vector3(); // from the ray's intersection with the plane to the point
  private vertical = false;

  // `normal`: of the plane of motion, of unit length; null: the point can move in all directions.
  constructor(
    private readonly stage: Stage,
    readonly goal: THREE.Vector3,
    private at: Pixel,
    private readonly normal: THREE.Vector3 | null = null,
  ) {
    this.hold();
  }

  move(at: Pixel, vertical: boolean): void {
    if (vertical !== this.vertical) {
      this.vertical = vertical;
      this.hold();
    }
    const before = this.at;
    this.at = at;
    if (!vertical && this.isEdgeOn()) {
      this.goal.add(this.alongEdge(at.x - before.x, before.y - at.y));
      return this.hold();
    }
    const met = this.meet();
    if (!met) return;
    met.add(this.offset);
    if (this.vertical) this.goal.z = met.z;
    else this.goal.copy(met);
  }

  // Along the line of sight, by a fraction of the distance.
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

  private get sight(): THREE.Vector3 {
    return this.stage.camera.getWorldDirection(new THREE.Vector3());
  }

  private isEdgeOn(): boolean {
    return this.normal !== null && Math.abs(this.sight.dot(this.normal)) < MIN_SINE;
  }

  // Pixels to the right and away from the eye, in the plane of motion.
  private alongEdge(right: number, away: number): THREE.Vector3 {
    const { camera, host } = this.stage;
    const x = new THREE.Vector3(1, 0, 0).applyQuaternion(camera.quaternion).projectOnPlane(this.normal!).normalize();
    const y = this.sight.projectOnPlane(this.normal!).normalize();
    const height = 2 * Math.tan((camera.fov * Math.PI) / 360) * this.goal.distanceTo(camera.position);
    const pixels = camera.view?.fullHeight ?? host.clientHeight;
    return x.multiplyScalar(right).addScaledVector(y, away).multiplyScalar(height / pixels);
  }

  private meet(): THREE.Vector3 | null {
    const facing = this.vertical || !this.normal ? this.sight : this.normal.clone();
    if (this.vertical) facing.addScaledVector(UP, -facing.dot(UP));
    if (facing.lengthSq() < 1e-3) return null; // seen from above: no vertical direction in the view
    const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(facing.normalize(), this.goal);
    return rayAt(this.stage, this.at).intersectPlane(plane, new THREE.Vector3());
  }
}

// Normal of the plane in which joints with these axes can move a point: the direction to which all rotations
// are parallel. Null: there is none, or a joint slides along it.
export function planeOfMotion(axes: Axis[]): THREE.Vector3 | null {
  const normal = axes.find(({ slides }) => !slides)?.direction;
  const isPlanar = ({ direction, slides }: Axis) => {
    const cosine = Math.abs(direction.dot(normal!));
    return slides ? cosine < 0.01 : cosine > 0.9999;
  };
  return normal && axes.every(isPlanar) ? normal.clone() : null;
}

export interface Axis {
  origin: THREE.Vector3;
  direction: THREE.Vector3; // of unit length
  slides: boolean;
}

const STEPS = 8;
const MIN_PIXELS = 30; // lower bound of |J|, for views along the motion

// Joint coordinate that keeps the grabbed point nearest to the pointer: least squares by Gauss-Newton steps
// dq = J e / |J|^2, with the pixel error e and J in pixels per radian (or metre).
export class JointDrag {
  private readonly start = this.value;

  constructor(
    private readonly stage: Stage,
    private readonly axis: Axis,
    private readonly grabbed: THREE.Vector3,
    public value: number,
    private readonly range: { low?: number; high?: number },
  ) {}

  move(at: Pixel): number {
    const unit = this.axis.slides ? 0.001 : 0.005; // of the finite difference J
    for (let i = 0; i < STEPS; ++i) {
      const here = this.pixel(this.value);
      const there = this.pixel(this.value + unit);
      if (!here || !there) break;
      const [jx, jy] = [(there.x - here.x) / unit, (there.y - here.y) / unit];
      const along = (at.x - here.x) * jx + (at.y - here.y) * jy;
      const step = along / Math.max(MIN_PIXELS ** 2, jx * jx + jy * jy);
      const max = this.axis.slides ? Infinity : 0.5;
      this.value += Math.min(max, Math.max(-max, step));
    }
    this.value = within(this.range, this.value);
    return this.value;
  }

  private pixel(value: number) {
    const { origin, direction, slides } = this.axis;
    const p = this.grabbed.clone();
    if (slides) p.addScaledVector(direction, value - this.start);
    else p.sub(origin).applyAxisAngle(direction, value - this.start).add(origin);
    return this.stage.project(...p.toArray());
  }
}
