// The pointer in the view: what is grabbed decides what it does. The ring or the ghost: the hand
// leads the robot. A solid body: a spring pulls it. Anything else: the view turns.
import type { Pixel, Stage } from '../view/stage';
import type { Operator } from './operator';
import { axisOf, type Handles, inLink, inWorld } from './handles';
import { JointDrag, PointDrag } from './drag_goal';
import type { Known, Pulling } from './key_input';
import type { Frame, SceneJoint, SceneMessage, Vector } from '../source/link';
import { type Hit, pick } from '../view/pick';
import { Pinch } from './pinch';

export type Seen = Known & { stage: Stage };

type Held =
  | { kind: 'tip'; drag: PointDrag }
  | { kind: 'joint'; joint: SceneJoint; drag: JointDrag }
  | { kind: 'pull'; body: number; point: Vector; drag: PointDrag }
  | { kind: 'click'; hit: Hit | null; x: number; y: number }; // may become a pull

const START = 5; // pixels that tell a drag from a click
const HINTS = {
  tip: 'drag: lead the hand · shift: up and down · wheel while dragging: nearer, farther',
  view: 'drag: turn the view · right button: move · wheel: zoom',
  tipHeld: 'leading the hand · shift: up and down · wheel: nearer, farther',
  pullHeld: 'pulling by a spring · shift: up and down · wheel: nearer, farther',
};

export class Drag {
  held: Held | null = null;
  hovered: Held['kind'] | 'view' = 'view';
  joint: SceneJoint | null = null; // whose arc is shown
  hint = HINTS.view;
  private hover: PointerEvent | null = null; // looked at once a picture
  private readonly pinch: Pinch;

  constructor(
    private readonly host: HTMLElement,
    private readonly seen: () => Seen | null,
    private readonly hand: Operator,
    private readonly handles: Handles,
    private readonly on: { select(body: number | null): void; changed(): void },
  ) {
    this.pinch = new Pinch(host, () => seen()?.stage ?? null, () => this.letGo());
    // Before the camera's own listeners, which lie on the canvas.
    host.addEventListener('pointerdown', (event) => this.down(event), { capture: true });
    host.addEventListener('pointermove', (event) => this.move(event));
    for (const end of ['pointerup', 'pointercancel'] as const)
      host.addEventListener(end, (event) => this.up(event));
    host.addEventListener('wheel', (event) => this.wheel(event), { capture: true, passive: false });
    host.addEventListener('pointerleave', () => (this.hover = null));
  }

  // Once a picture: what the pointer is over, and a goal that the pointer holds though it rests.
  tick(): void {
    if (this.hover && !this.held) this.look(this.hover);
    this.hover = null;
  }

  // After the frame is painted. `keys`: what the keyboard pulls or turns.
  draw({ stage, scene, frame }: Seen, keys: { joint: SceneJoint | null; pulling: Pulling | null }): void {
    const { held, handles } = this;
    const at = handles.showTip(stage, handles.tipPlace(frame, scene));
    const goal = held?.kind === 'tip' ? stage.project(...held.drag.goal.toArray()) : null;
    handles.showLeader(at, goal);
    const joint = this.joint ?? keys.joint;
    const value = joint ? this.valueOf(frame, scene, joint) : 0;
    handles.showArc(stage, frame, joint, value, 0.2 * scene.view.radius);
    const pull = held?.kind === 'pull' ? { ...held, goal: held.drag.goal } : keys.pulling;
    if (!pull) return handles.showSpring(null, null, '');
    const from = inWorld(frame.link, pull.body, pull.point);
    const newtons = channel(frame, scene, 'pull');
    const words = Number.isFinite(newtons) ? `${newtons.toFixed(1)} N` : '';
    const to = stage.project(...pull.goal.toArray());
    handles.showSpring(from && stage.project(...from.toArray()), to, words);
  }

  private place(event: { clientX: number; clientY: number }) {
    const { left, top } = this.host.getBoundingClientRect();
    return { x: event.clientX - left, y: event.clientY - top };
  }

  private isOurs(event: Event): boolean {
    return event.target instanceof HTMLCanvasElement || event.target === this.handles.tip;
  }

  private down(event: PointerEvent): void {
    const seen = this.seen();
    if (this.pinch.isPassing() || !seen || !this.isOurs(event)) return;
    if (event.button !== 0 || !event.isPrimary || event.altKey) return;
    const at = this.place(event);
    if (event.target === this.handles.tip) {
      const tip = this.handles.tipPlace(seen.frame, seen.scene);
      if (!tip || !this.hand.lead('drag')) return;
      this.take(event, { kind: 'tip', drag: new PointDrag(seen.stage, tip, at) });
      return;
    }
    const found = this.find(seen, at);
    if (found.kind === 'joint') {
      if (!this.hand.lead('joints')) return;
      const { stage, scene, frame } = seen;
      const { joint, point } = found;
      const axis = axisOf(frame, joint);
      if (!axis) return;
      const drag = new JointDrag(stage, axis, point, this.valueOf(frame, scene, joint), joint);
      this.take(event, { kind: 'joint', joint, drag });
    } else {
      const moves = found.hit && seen.scene.bodies[found.hit.body]?.moves;
      const click = { kind: 'click', hit: found.hit, ...at } as const;
      if (moves) this.take(event, click);
      else this.held = click; // the camera has it; a click still selects
    }
  }

  private take(event: PointerEvent, held: Held): void {
    this.held = held;
    this.hint = held.kind === 'tip' ? HINTS.tipHeld : this.hint;
    const { stage } = this.seen()!;
    stage.controls.enabled = false;
    this.host.setPointerCapture(event.pointerId);
    this.host.dataset.held = held.kind;
    if (held.kind === 'tip') this.handles.tip.focus({ preventScroll: true });
    event.preventDefault();
  }

  private move(event: PointerEvent): void {
    const { held } = this;
    const seen = this.seen();
    if (!held || !seen) {
      this.hover = event;
      return;
    }
    const at = this.place(event);
    if (held.kind === 'click') return this.moveClick(seen, held, at);
    if (held.kind === 'joint') {
      this.hand.move({ do: 'joint', index: held.joint.driven!, value: held.drag.move(at) });
      return this.on.changed();
    }
    held.drag.move(at, event.shiftKey);
    this.sendGoal(held);
  }

  private moveClick(seen: Seen, held: Held & { kind: 'click' }, at: Pixel): void {
    if (Math.hypot(at.x - held.x, at.y - held.y) < START) return;
    this.held = null;
    const { hit } = held;
    if (!hit || seen.stage.controls.enabled) return; // the camera turns
    const point = inLink(seen.frame.link, hit.body, hit.point);
    if (!point || !this.hand.claim()) return this.release();
    const drag = new PointDrag(seen.stage, hit.point.clone(), held);
    this.held = { kind: 'pull', body: hit.body, point, drag };
    this.host.dataset.held = 'pull';
    this.hint = HINTS.pullHeld;
    drag.move(at, false);
    this.sendGoal(this.held);
  }

  private wheel(event: WheelEvent): void {
    const { held } = this;
    if (held?.kind !== 'tip' && held?.kind !== 'pull') return;
    event.preventDefault();
    event.stopPropagation();
    held.drag.deepen(-0.0004 * event.deltaY);
    this.sendGoal(held);
  }

  private sendGoal(held: Held & { kind: 'tip' | 'pull' }): void {
    const goal = held.drag.goal.toArray();
    if (held.kind === 'tip') this.hand.move({ do: 'tip', goal });
    else this.hand.move({ do: 'pull', body: held.body, point: held.point, goal });
    this.on.changed();
  }

  private up(event: PointerEvent): void {
    const { held } = this;
    if (!held || !event.isPrimary) return;
    if (held.kind === 'click') this.on.select(held.hit?.body ?? null);
    if (held.kind === 'pull') this.hand.drop();
    this.release();
    this.hover = event;
  }

  // A second finger has come. True: the camera did not have the first one. The ring is kept.
  private letGo(): boolean {
    const { held } = this;
    const hasCamera = this.seen()?.stage.controls.enabled ?? true;
    if (held?.kind === 'tip') return false;
    if (held?.kind === 'pull') this.hand.drop();
    this.release();
    return !hasCamera;
  }

  private release(): void {
    this.held = null;
    this.hint = HINTS.view;
    delete this.host.dataset.held;
    const seen = this.seen();
    if (seen) seen.stage.controls.enabled = true;
    this.on.changed();
  }

  // A ghost counts where it stands apart from the solid link that follows it.
  private find({ stage, scene, frame }: Seen, at: Pixel) {
    const hit = pick(stage, frame, 0, at);
    const ghosts = scene.layers.findIndex(({ name }) => name === 'ghost');
    const ghost = ghosts > 0 ? pick(stage, frame, ghosts, at) : null;
    const isLed = ({ body, driven, axis }: SceneJoint) => body === ghost?.body && driven !== undefined && axis;
    const joint = ghost && scene.joints.find(isLed);
    if (joint && (!hit || ghost.distance < hit.distance - 0.03 * scene.view.radius))
      return { kind: 'joint', joint, point: ghost.point } as const;
    return { kind: 'body', hit } as const;
  }

  private look(event: PointerEvent): void {
    const seen = this.seen();
    if (!seen || !this.isOurs(event)) return;
    const before = this.joint;
    this.joint = null;
    if (event.target === this.handles.tip) this.say('tip', HINTS.tip);
    else {
      const found = this.find(seen, this.place(event));
      const body = found.kind === 'body' && found.hit ? seen.scene.bodies[found.hit.body] : null;
      if (found.kind === 'joint') {
        this.joint = found.joint;
        this.say('joint', `drag: turn joint ${found.joint.name} of the hand's robot`);
      } else if (body?.moves) this.say('pull', `drag: pull ${body.name} by a spring · click: select it`);
      else if (body) this.say('view', `click: select ${body.name} · ${HINTS.view}`);
      else this.say('view', HINTS.view);
    }
    if (before !== this.joint) this.on.changed();
  }

  private say(kind: Held['kind'] | 'view', hint: string): void {
    this.hovered = kind;
    this.hint = hint;
    this.host.dataset.over = kind;
  }

  valueOf(frame: Frame, scene: SceneMessage, joint: SceneJoint): number {
    if (this.held?.kind === 'joint' && this.held.joint === joint) return this.held.drag.value;
    const target = channel(frame, scene, 'target', joint.name);
    return Number.isFinite(target) ? target : channel(frame, scene, 'coordinate', joint.name);
  }
}

// The newest value of a channel; NaN: there is none.
export function channel(frame: Frame, scene: SceneMessage, kind: string, of?: string): number {
  const at = scene.channels.findIndex((c) => c.kind === kind && (of === undefined || c.of === of));
  return at < 0 ? NaN : frame.channels[at];
}
