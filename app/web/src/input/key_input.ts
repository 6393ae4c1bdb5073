// The hand by keys alone: the tip, a joint, or a spring at the selected body, whichever was chosen;
// arrows then move it as the picture shows it.
import * as THREE from 'three';
import type { Stage } from '../view/stage';
import type { Drag } from './drag';
import type { Operator } from './operator';
import { type Handles, inWorld } from './handles';
import { within } from '../ui/scale';
import type { Frame, SceneJoint, SceneMessage, Vector } from '../source/link';

const STEP = 0.02; // of the size of what is seen
const TURN = Math.PI / 90;
const FAR = 0.25; // of that size: from there on the goal begins anew at the tip

export interface Pulling {
  body: number;
  point: Vector; // link axes
  goal: THREE.Vector3;
}

// Without a stage (the browser cannot draw) the hand moves along the world's axes.
export type Known = { scene: SceneMessage; frame: Frame; stage: Stage | null };

type Mode = { kind: 'tip' } | { kind: 'joint'; joint: SceneJoint; value: number } | { kind: 'pull'; at: Pulling };

export class KeyInput {
  private mode: Mode | null = null;
  private goal: THREE.Vector3 | null = null; // of the tip
  private readonly stylus = [0, 0, 0];

  constructor(
    private readonly seen: () => Known | null,
    private readonly hand: Operator,
    private readonly handles: Handles,
    private readonly drag: Drag,
    private readonly changed: () => void,
  ) {
    handles.tip.addEventListener('focus', () => {
      if (this.mode?.kind !== 'joint') this.set({ kind: 'tip' });
    });
    handles.tip.addEventListener('blur', () => {
      if (this.mode?.kind !== 'pull') this.leave();
    });
  }

  get joint(): SceneJoint | null {
    return this.mode?.kind === 'joint' ? this.mode.joint : null;
  }
  get pulling(): Pulling | null {
    return this.mode?.kind === 'pull' ? this.mode.at : null;
  }
  get isOn(): boolean {
    return this.mode !== null;
  }

  get hint(): string | null {
    const { mode } = this;
    if (mode?.kind === 'tip')
      return 'arrows: move the hand · page up, down: away, toward · shift: turn the stylus · j: joints';
    if (mode?.kind === 'joint') {
      const shown = mode.joint.slides
        ? `${(1000 * mode.value).toFixed(0)} mm`
        : `${((180 / Math.PI) * mode.value).toFixed(0)}°`;
      return `joint ${mode.joint.name}, ${shown.replace('-', '−')} · arrows: turn it · j: next joint · h: the tip`;
    }
    if (mode?.kind === 'pull') return 'arrows: pull · page up, down: away, toward · x: let go';
    return null;
  }

  focusTip(): void {
    this.set({ kind: 'tip' });
    this.handles.tip.focus({ preventScroll: true });
  }

  nextJoint(): void {
    const seen = this.seen();
    const driven = seen?.scene.joints.filter((j) => j.driven !== undefined && j.axis) ?? [];
    if (!seen || driven.length === 0) return;
    const at = this.joint ? driven.findIndex(({ name }) => name === this.joint!.name) : -1;
    const joint = driven[(at + 1) % driven.length];
    this.set({ kind: 'joint', joint, value: this.drag.valueOf(seen.frame, seen.scene, joint) });
    this.handles.tip.focus({ preventScroll: true });
  }

  togglePull(body: number | null): void {
    if (this.mode?.kind === 'pull') return this.leave();
    const seen = this.seen();
    const goal = seen && body !== null ? inWorld(seen.frame.link, body, [0, 0, 0]) : null;
    if (!goal || body === null || !seen!.scene.bodies[body].moves || !this.hand.claim()) return;
    this.handles.tip.blur();
    this.set({ kind: 'pull', at: { body, point: [0, 0, 0], goal } });
  }

  leave(): void {
    if (this.mode?.kind === 'pull') this.hand.drop();
    this.mode = this.goal = null;
    if (document.activeElement === this.handles.tip) this.handles.tip.blur();
    this.changed();
  }

  // As the picture shows it: to the right, up, away from the eye; each -1, 0 or 1.
  move(right: number, up: number, away: number, turn: boolean): void {
    const seen = this.seen();
    const { mode } = this;
    if (!seen || !mode) return;
    if (mode.kind === 'joint') this.moveJoint(mode, right + up);
    else if (mode.kind === 'pull') {
      mode.at.goal.add(this.along(seen, right, up, away));
      const { body, point, goal } = mode.at;
      this.hand.move({ do: 'pull', body, point, goal: goal.toArray() });
    } else if (turn) this.turnStylus(right, up, away);
    else this.moveTip(seen, this.along(seen, right, up, away));
    this.changed();
  }

  private moveTip(seen: Known, by: THREE.Vector3): void {
    const tip = this.handles.tipPlace(seen.frame, seen.scene);
    if (!tip || !this.hand.lead('drag')) return;
    if (!this.goal || this.goal.distanceTo(tip) > FAR * seen.scene.view.radius) this.goal = tip;
    this.goal.add(by);
    this.hand.move({ do: 'tip', goal: this.goal.toArray() });
  }

  private moveJoint(mode: Mode & { kind: 'joint' }, by: number): void {
    if (!this.hand.lead('joints')) return;
    const { slides, driven } = mode.joint;
    mode.value = within(mode.joint, mode.value + by * (slides ? 0.01 : TURN));
    this.hand.move({ do: 'joint', index: driven!, value: mode.value });
  }

  private turnStylus(right: number, up: number, away: number): void {
    if (!this.hand.lead('drag')) return;
    [-right, up, away].forEach((by, i) => (this.stylus[i] += 2.5 * TURN * by));
    const [yaw, pitch, roll] = this.stylus;
    this.hand.move({ do: 'turn', yaw, pitch, roll });
  }

  private along({ stage, scene }: Known, right: number, up: number, away: number): THREE.Vector3 {
    const x = new THREE.Vector3(1, 0, 0);
    if (stage) x.applyQuaternion(stage.camera.quaternion).setZ(0).normalize();
    const z = new THREE.Vector3(0, 0, 1);
    const y = z.clone().cross(x);
    const by = x.multiplyScalar(right).addScaledVector(z, up).addScaledVector(y, away);
    return by.multiplyScalar(STEP * scene.view.radius);
  }

  private set(mode: Mode): void {
    this.mode = mode;
    this.goal = null;
    this.changed();
  }
}
