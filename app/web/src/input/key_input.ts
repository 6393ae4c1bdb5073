// Keyboard input: arrow keys move the tip of the target robot, one of its joints, or the spring on the
// selected body, in directions of the view.
import * as THREE from 'three';
import type { Operator } from './operator';
import { type AppliedSpring, type Handles, inWorld, type LabView, tipPlane } from './handles';
import { within } from '../ui/scale';
import type { SceneJoint } from '../source/link';

const STEP = 0.02; // of the size of the scene
const ANGLE = Math.PI / 90; // [rad]
const FAR = 0.25; // of the size of the scene: a goal farther from the tip is reset to the tip

type JointMode = { kind: 'joint'; joint: SceneJoint; value: number };
type Mode = { kind: 'tip' } | JointMode | ({ kind: 'spring' } & AppliedSpring);

export class KeyInput {
  private mode: Mode | null = null;
  private goal: THREE.Vector3 | null = null; // of the tip
  private readonly stylus = [0, 0, 0];

  constructor(
    private readonly view: () => LabView | null,
    private readonly operator: Operator,
    private readonly handles: Handles,
    private readonly jointValue: (view: LabView, joint: SceneJoint) => number,
    private readonly changed: () => void,
  ) {
    handles.tip.addEventListener('focus', () => {
      if (this.mode?.kind !== 'joint') this.set({ kind: 'tip' });
    });
    handles.tip.addEventListener('blur', () => {
      if (this.mode?.kind !== 'spring') this.leave();
    });
  }

  get joint(): SceneJoint | null {
    return this.mode?.kind === 'joint' ? this.mode.joint : null;
  }
  get spring(): AppliedSpring | null {
    return this.mode?.kind === 'spring' ? this.mode : null;
  }
  get isOn(): boolean {
    return this.mode !== null;
  }

  get hint(): string | null {
    const { mode } = this;
    if (mode?.kind === 'tip')
      return 'arrows: move the end effector · page up, down: depth · shift: rotate the stylus · j: joints';
    if (mode?.kind === 'spring') return 'arrows: move the spring · page up, down: depth · x: release';
    if (!mode) return null;
    const { slides, name } = mode.joint;
    const [factor, unit] = slides ? [1000, ' mm'] : [180 / Math.PI, '°'];
    const text = `${(factor * mode.value).toFixed(0)}${unit}`;
    return `joint ${name}, ${text.replace('-', '−')} · arrows: move it · j: next joint · h: end effector`;
  }

  focusTip(): void {
    this.set({ kind: 'tip' });
    this.handles.tip.focus({ preventScroll: true });
  }

  nextJoint(): void {
    const view = this.view();
    const driven = view?.scene.joints.filter((j) => j.driven !== undefined && j.axis) ?? [];
    if (!view || driven.length === 0) return;
    const at = this.joint ? driven.findIndex(({ name }) => name === this.joint!.name) : -1;
    const joint = driven[(at + 1) % driven.length];
    this.set({ kind: 'joint', joint, value: this.jointValue(view, joint) });
    this.handles.tip.focus({ preventScroll: true });
  }

  toggleSpring(body: number | null): void {
    if (this.mode?.kind === 'spring') return this.leave();
    const view = this.view();
    const goal = view && body !== null ? inWorld(view.frame.link, body, [0, 0, 0]) : null;
    if (!goal || body === null || !view!.scene.bodies[body].moves || !this.operator.requestControl()) return;
    this.handles.tip.blur();
    this.set({ kind: 'spring', body, point: [0, 0, 0], goal });
  }

  leave(): void {
    if (this.mode?.kind === 'spring') this.operator.releaseSpring();
    this.mode = this.goal = null;
    if (document.activeElement === this.handles.tip) this.handles.tip.blur();
    this.changed();
  }

  // In directions of the view: right, up, away from the eye; each -1, 0 or 1.
  move(right: number, up: number, away: number, rotates: boolean): void {
    const view = this.view();
    const { mode } = this;
    if (!view || !mode) return;
    if (mode.kind === 'joint') this.moveJoint(mode, right + up);
    else if (mode.kind === 'spring') {
      mode.goal.add(this.along(view, right, up, away));
      const { body, point, goal } = mode;
      this.operator.move({ do: 'drag_body', body, point, goal: goal.toArray() });
    } else if (rotates) this.rotateStylus(right, up, away);
    else if (tipPlane(view)) this.moveTip(view, this.along(view, right, 0, up + away));
    else this.moveTip(view, this.along(view, right, up, away));
    this.changed();
  }

  private moveTip(view: LabView, by: THREE.Vector3): void {
    const tip = this.handles.tipPosition(view);
    if (!tip || !this.operator.useSource('drag')) return;
    if (!this.goal || this.goal.distanceTo(tip) > FAR * view.scene.view.radius) this.goal = tip;
    this.goal.add(by);
    this.operator.move({ do: 'drag_stylus', goal: this.goal.toArray() });
  }

  private moveJoint(mode: JointMode, by: number): void {
    if (!this.operator.useSource('joints')) return;
    const { slides, driven } = mode.joint;
    mode.value = within(mode.joint, mode.value + by * (slides ? 0.01 : ANGLE));
    this.operator.move({ do: 'joint', index: driven!, value: mode.value });
  }

  private rotateStylus(right: number, up: number, away: number): void {
    if (!this.operator.useSource('drag')) return;
    [-right, up, away].forEach((by, i) => (this.stylus[i] += 2.5 * ANGLE * by));
    const [yaw, pitch, roll] = this.stylus;
    this.operator.move({ do: 'rotate_stylus', yaw, pitch, roll });
  }

  // Without a stage: along the world axes.
  private along({ stage, scene }: LabView, right: number, up: number, away: number): THREE.Vector3 {
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
