// What is drawn over the picture for a hand: the ring at the tip of the kinematic robot (a button,
// so that fingers and keys find it), the arc of a joint that is turned, the spring under the mouse.
// In the page's own pixels: sharp, and no picture later than the mouse.
import './handles.css';
import * as THREE from 'three';
import { element, svg } from '../ui/dom';
import type { Pixel, Stage } from '../view/stage';
import type { Axis } from './drag_goal';
import { type Frame, placeOf, type SceneJoint, type SceneMessage, type Vector } from '../source/link';

const POINTS = 48; // of an arc
const COILS = 9;

const path = (className: string) => svg('path', { class: className });

function poseOf(places: Float32Array, body: number) {
  const place = placeOf(places, body);
  const turn = new THREE.Quaternion().fromArray(places, 7 * body + 3).normalize();
  return place && { origin: new THREE.Vector3(...place), turn };
}

// A point of link axes in the world; null: the link's place is not known.
export function inWorld(places: Float32Array, body: number, p: Vector): THREE.Vector3 | null {
  const pose = poseOf(places, body);
  return pose && new THREE.Vector3(...p).applyQuaternion(pose.turn).add(pose.origin);
}
export function inLink(places: Float32Array, body: number, p: THREE.Vector3): Vector | null {
  const pose = poseOf(places, body);
  return pose && p.clone().sub(pose.origin).applyQuaternion(pose.turn.conjugate()).toArray();
}

// Of a joint of the kinematic robot.
export function axisOf(frame: Frame, { body, axis, slides }: SceneJoint): Axis | null {
  const origin = inWorld(frame.twin, body, [0, 0, 0]);
  if (!axis || !origin) return null;
  const direction = inWorld(frame.twin, body, axis)!.sub(origin).normalize();
  return { origin, direction, slides: slides ?? false };
}

export class Handles {
  readonly tip = element('button.grip', { type: 'button', hidden: '' });
  private readonly svg = svg('svg', { 'aria-hidden': 'true' });
  private readonly track = path('arc');
  private readonly turned = path('arc turned');
  private readonly leader = path('leader');
  private readonly spring = path('spring');
  private readonly words = element('output.pulled', { hidden: '' });

  constructor(host: HTMLElement) {
    this.tip.setAttribute('aria-label', 'the hand: arrow keys move it, page up and down too');
    this.svg.append(this.track, this.turned, this.leader, this.spring);
    host.append(this.svg, this.words, this.tip);
  }

  // Where the hand's point of the kinematic robot is, and the ring around it.
  tipPlace(frame: Frame, scene: SceneMessage): THREE.Vector3 | null {
    const { tip } = scene;
    if (!tip || tip.body >= frame.bodies) return null;
    return inWorld(frame.twin, tip.body, tip.p);
  }
  showTip(stage: Stage, place: THREE.Vector3 | null): Pixel | null {
    const at = place && stage.project(...place.toArray());
    this.tip.hidden = !at;
    if (at) this.tip.style.transform = `translate(${at.x.toFixed(1)}px, ${at.y.toFixed(1)}px)`;
    return at;
  }

  // From the tip to where it is wanted, if that is farther than it reaches.
  showLeader(from: Pixel | null, to: Pixel | null): void {
    const far = from && to && Math.hypot(to.x - from.x, to.y - from.y) > 14;
    this.leader.setAttribute('d', far ? `M${from.x} ${from.y}L${to.x} ${to.y}` : '');
  }

  showSpring(from: Pixel | null, to: Pixel | null, words: string): void {
    this.words.hidden = !to || !words;
    if (!from || !to) return this.spring.setAttribute('d', '');
    const [dx, dy] = [to.x - from.x, to.y - from.y];
    const length = Math.hypot(dx, dy) || 1;
    const [nx, ny] = [(-dy / length) * 5, (dx / length) * 5];
    const at = (share: number, side: number) =>
      `${(from.x + share * dx + side * nx).toFixed(1)} ${(from.y + share * dy + side * ny).toFixed(1)}`;
    const coils = Array.from({ length: COILS }, (_, i) =>
      at(0.12 + (0.76 * (i + 0.5)) / COILS, i % 2 ? 1 : -1),
    );
    const points = [at(0, 0), at(0.12, 0), ...coils, at(0.88, 0), at(1, 0)];
    this.spring.setAttribute('d', `M${points.join('L')}`);
    this.words.textContent = words;
    this.words.style.transform = `translate(${to.x + 16}px, ${to.y + 14}px)`;
  }

  // The range of a joint about its axis, and where it stands; null: none.
  showArc(stage: Stage, frame: Frame, joint: SceneJoint | null, value: number, reach: number): void {
    const found = joint && axisOf(frame, joint);
    if (!joint || !found) {
      this.track.setAttribute('d', '');
      this.turned.setAttribute('d', '');
      return;
    }
    const { origin, direction: axis } = found;
    const radial = aside(frame, joint.body, axis, origin).multiplyScalar(reach);
    const bound = (limit: number | undefined, otherwise: number) =>
      limit !== undefined && Math.abs(limit) < 1e3 ? limit : otherwise;
    const low = bound(joint.low, value - Math.PI);
    const high = bound(joint.high, value + Math.PI);
    // The link is at `value` now: angles are counted from there.
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

// Across the axis, towards the link's child or whatever of it is farthest from the axis.
function aside(frame: Frame, body: number, axis: THREE.Vector3, origin: THREE.Vector3): THREE.Vector3 {
  const best = new THREE.Vector3();
  for (let i = frame.first[0]; i < frame.first[1]; ++i) {
    if (frame.body[i] !== body) continue;
    // Entries are those of the dynamic link: taken into link axes there, and out by the twin.
    const entry = new THREE.Vector3().fromArray(frame.position, 3 * i);
    const local = inLink(frame.link, body, entry);
    const away = local && inWorld(frame.twin, body, local)?.sub(origin);
    if (!away) continue;
    away.addScaledVector(axis, -away.dot(axis));
    if (away.lengthSq() > best.lengthSq()) best.copy(away);
  }
  if (best.lengthSq() < 1e-8)
    best.set(1, 0, 0).cross(axis).lengthSq() > 0.01 ? best.set(1, 0, 0).cross(axis) : best.set(0, 1, 0);
  return best.normalize();
}
