// A joint that a pointer turns: the point that was grabbed stays under the pointer as well as one
// joint can hold it there. On the picture that is a least-squares fit of one number: with J, the
// point's pixels per radian (or metre), each step adds e J / |J|^2. It holds from any side.
import * as THREE from 'three';
import type { Stage } from '../view/stage';

export interface Axis {
  origin: THREE.Vector3;
  direction: THREE.Vector3; // of unit length
  slides: boolean;
}

const STEPS = 8;
const LEAST = 30; // pixels: from where the axis hides the motion, a small one is not made a large one

export function within({ low, high }: { low?: number; high?: number }, value: number): number {
  return Math.min(high ?? Infinity, Math.max(low ?? -Infinity, value));
}

export class JointDrag {
  private readonly start: number;

  constructor(
    private readonly stage: Stage,
    private readonly axis: Axis,
    private readonly grabbed: THREE.Vector3,
    public value: number,
    private readonly range: { low?: number; high?: number },
  ) {
    this.start = value;
  }

  move(at: { x: number; y: number }): number {
    const unit = this.axis.slides ? 0.001 : 0.005; // small: J is that of here
    for (let i = 0; i < STEPS; ++i) {
      const here = this.pixel(this.value);
      const there = this.pixel(this.value + unit);
      if (!here || !there) break;
      const [jx, jy] = [(there.x - here.x) / unit, (there.y - here.y) / unit];
      const along = (at.x - here.x) * jx + (at.y - here.y) * jy;
      const step = along / Math.max(LEAST * LEAST, jx * jx + jy * jy);
      const most = this.axis.slides ? Infinity : 0.5;
      this.value += Math.min(most, Math.max(-most, step));
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
