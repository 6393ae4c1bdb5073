// Handles over the 3-D view, as SVG: the ring at the tip of the target robot (a button, for touch and
// keyboard), the range of a joint, the spring of the mouse.
import './handles.css';
import * as THREE from 'three';
import { element, svg } from '../ui/dom';
import type { Pixel, Stage } from '../view/stage';
import { type Axis, planeOfMotion } from './drag_goal';
import { type Frame, placeOf, type SceneJoint, type SceneMessage, type Vector } from '../source/link';

const POINTS = 48; // of an arc
const COILS = 9;

// Without a stage (no WebGL) there is keyboard input only.
export type LabView = { scene: SceneMessage; frame: Frame; stage: Stage | null };

export interface AppliedSpring {
  body: number;
  point: Vector; // link axes
  goal: THREE.Vector3;
}

const path = (className: string) => svg('path', { class: className });

function poseOf(places: Float32Array, body: number) {
  const place = placeOf(places, body);
  const turn = new THREE.Quaternion().fromArray(places, 7 * body + 3).normalize();
  return place && { origin: new THREE.Vector3(...place), turn };
}

// A point in link axes, in the world; null: the pose of the link is unknown.
export function inWorld(places: Float32Array, body: number, p: Vector): THREE.Vector3 | null {
  const pose = poseOf(places, body);
  return pose && new THREE.Vector3(...p).applyQuaternion(pose.turn).add(pose.origin);
}
export function inLink(places: Float32Array, body: number, p: THREE.Vector3): Vector | null {
  const pose = poseOf(places, body);
  return pose && p.clone().sub(pose.origin).applyQuaternion(pose.turn.conjugate()).toArray();
}

// Axis of a joint of the target robot, in the world.
export function axisOf(frame: Frame, { body, axis, slides }: SceneJoint): Axis | null {
  const origin = inWorld(frame.target, body, [0, 0, 0]);
  if (!axis || !origin) return null;
  const direction = inWorld(frame.target, body, axis)!.sub(origin).normalize();
  return { origin, direction, slides: slides ?? false };
}

// Normal of the plane in which the driven joints move the tip; null: it can leave any plane. Bodies are numbered
// outward: joints of later bodies do not move it.
export function tipPlane({ frame, scene }: LabView) {
  const inner = scene.joints.filter((joint) => joint.driven !== undefined && joint.body <= (scene.tip?.body ?? -1));
  return planeOfMotion(inner.map((joint) => axisOf(frame, joint)).filter((axis) => axis !== null));
}

export class Handles {
  readonly tip = element('button.grip', { type: 'button', hidden: '' });
  private readonly svg = svg('svg', { 'aria-hidden': 'true' });
  private readonly track = path('arc');
  private readonly turned = path('arc turned');
  private readonly goalLine = path('goal-line');
  private readonly spring = path('spring');
  private readonly force = element('output.spring-force', { hidden: '' });

  constructor(host: HTMLElement) {
    this.tip.setAttribute('aria-label', 'end effector: arrow keys, page up and page down move it');
    this.svg.append(this.track, this.turned, this.goalLine, this.spring);
    host.append(this.svg, this.force, this.tip);
  }

  tipPosition({ frame, scene: { tip } }: LabView): THREE.Vector3 | null {
    if (!tip || tip.body >= frame.bodies) return null;
    return inWorld(frame.target, tip.body, tip.p);
  }
  showTip(stage: Stage, place: THREE.Vector3 | null): Pixel | null {
    const at = place && stage.project(...place.toArray());
    this.tip.hidden = !at;
    if (at) this.tip.style.transform = `translate(${at.x.toFixed(1)}px, ${at.y.toFixed(1)}px)`;
    return at;
  }

  // From the tip to its goal, if that is out of reach.
  showGoalLine(from: Pixel | null, to: Pixel | null): void {
    const far = from && to && Math.hypot(to.x - from.x, to.y - from.y) > 14;
    this.goalLine.setAttribute('d', far ? `M${from.x} ${from.y}L${to.x} ${to.y}` : '');
  }

  showSpring(from: Pixel | null, to: Pixel | null, force: string): void {
    this.force.hidden = !to || !force;
    if (!from || !to) return this.spring.setAttribute('d', '');
    const [dx, dy] = [to.x - from.x, to.y - from.y];
    const length = Math.hypot(dx, dy) || 1;
    const [nx, ny] = [(-dy / length) * 5, (dx / length) * 5];
    const at = (share: number, side: number) =>
      `${(from.x + share * dx + side * nx).toFixed(1)} ${(from.y + share * dy + side * ny).toFixed(1)}`;
    const coils = Array.from({ length: COILS }, (_, i) => at(0.12 + (0.76 * (i + 0.5)) / COILS, i % 2 ? 1 : -1));
    const points = [at(0, 0), at(0.12, 0), ...coils, at(0.88, 0), at(1, 0)];
    this.spring.setAttribute('d', `M${points.join('L')}`);
    this.force.textContent = force;
    this.force.style.transform = `translate(${to.x + 16}px, ${to.y + 14}px)`;
  }

  // Range and position of a joint, about or along its axis; null: none.
  showArc(stage: Stage, frame: Frame, joint: SceneJoint | null, value: number, reach: number): void {
    const found = joint && axisOf(frame, joint);
    if (!joint || !found) {
      for (const arc of [this.track, this.turned]) arc.setAttribute('d', '');
      return;
    }
    const { origin, direction: axis } = found;
    const radial = radialDirection(frame, joint.body, axis, origin).multiplyScalar(reach);
    const bound = (limit: number | undefined, otherwise: number) =>
      limit !== undefined && Math.abs(limit) < 1e3 ? limit : otherwise;
    const low = bound(joint.low, value - Math.PI);
    const high = bound(joint.high, value + Math.PI);
    // Relative to `value`, where the link is now.
    const point = (angle: number) =>
      joint.slides
        ? origin.clone().addScaledVector(axis, angle - value)
        : radial.clone().applyAxisAngle(axis, angle - value).add(origin);
    const line = (from: number, to: number) =>
      Array.from({ length: POINTS + 1 }, (_, i) => point(from + ((to - from) * i) / POINTS))
        .map((p) => stage.project(...p.toArray()))
        .filter((p) => p !== null)
        .map((p, i) => `${i ? 'L' : 'M'}${p.x.toFixed(1)} ${p.y.toFixed(1)}`)
        .join('');
    this.track.setAttribute('d', line(low, high));
    const zero = Math.min(high, Math.max(low, 0));
    const spoke = stage.project(...origin.toArray());
    const hub = !joint.slides && spoke ? `M${spoke.x.toFixed(1)} ${spoke.y.toFixed(1)}L` : 'M';
    this.turned.setAttribute('d', line(zero, value) + hub + line(value, value).split('L')[0].slice(1));
  }
}

// Perpendicular to the axis, towards the instance of the link that is farthest from the axis.
function radialDirection(frame: Frame, body: number, axis: THREE.Vector3, origin: THREE.Vector3) {
  const best = new THREE.Vector3();
  for (let i = frame.first[0]; i < frame.first[1]; ++i) {
    if (frame.body[i] !== body) continue;
    // Instances of the robot's link, moved to the link of the target robot.
    const entry = new THREE.Vector3().fromArray(frame.position, 3 * i);
    const local = inLink(frame.link, body, entry);
    const away = local && inWorld(frame.target, body, local)?.sub(origin);
    if (!away) continue;
    away.addScaledVector(axis, -away.dot(axis));
    if (away.lengthSq() > best.lengthSq()) best.copy(away);
  }
  if (best.lengthSq() < 1e-8)
    best.set(1, 0, 0).cross(axis).lengthSq() > 0.01 ? best.set(1, 0, 0).cross(axis) : best.set(0, 1, 0);
  return best.normalize();
}
