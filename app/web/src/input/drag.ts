// Pointer input in the 3-D view. The ring or a link of the target robot: moves the target robot. A link of
// the robot: applies a spring force. Elsewhere: rotates the view.
import type { Pixel, Stage } from '../view/stage';
import type { Operator } from './operator';
import { type AppliedSpring, axisOf, type Handles, inLink, inWorld, type LabView, tipPlane } from './handles';
import { JointDrag, PointDrag } from './drag_goal';
import type { Frame, SceneJoint, SceneMessage, Vector } from '../source/link';
import { type Hit, pick } from '../view/pick';
import { Pinch } from './pinch';

type DrawnView = LabView & { stage: Stage };
type Held =
  | { kind: 'tip'; drag: PointDrag }
  | { kind: 'joint'; joint: SceneJoint; drag: JointDrag }
  | { kind: 'spring'; body: number; point: Vector; drag: PointDrag }
  | { kind: 'click'; hit: Hit | null; x: number; y: number }; // may become a spring

const START = 5; // pixels from a click to a drag
const HINTS = {
  tip: 'drag: move the end effector · shift: vertical · wheel while dragging: depth',
  view: 'drag: rotate the view · right button: pan · wheel: zoom',
  tipHeld: 'moving the end effector · shift: vertical · wheel: depth',
  springHeld: 'applying a spring force · shift: vertical · wheel: depth',
};

export class Drag {
  held: Held | null = null;
  joint: SceneJoint | null = null; // whose range is shown
  hint = HINTS.view;
  private hover: PointerEvent | null = null; // handled once per picture
  private readonly pinch: Pinch;

  constructor(
    private readonly host: HTMLElement,
    private readonly labView: () => LabView | null,
    private readonly operator: Operator,
    private readonly handles: Handles,
    private readonly on: { select(body: number | null): void; changed(): void },
  ) {
    this.pinch = new Pinch(host, () => this.view()?.stage ?? null, () => this.cancel());
    // In the capture phase, before the listeners of the camera on the canvas.
    host.addEventListener('pointerdown', (event) => this.down(event), { capture: true });
    host.addEventListener('pointermove', (event) => this.move(event));
    for (const end of ['pointerup', 'pointercancel'] as const)
      host.addEventListener(end, (event) => this.up(event));
    host.addEventListener('wheel', (event) => this.wheel(event), { capture: true, passive: false });
    host.addEventListener('pointerleave', () => (this.hover = null));
  }

  private view(): DrawnView | null {
    const view = this.labView();
    return view?.stage ? { ...view, stage: view.stage } : null;
  }

  // Once per picture.
  tick(): void {
    if (this.hover && !this.held) this.look(this.hover);
    this.hover = null;
  }

  // After the frame has been drawn. `keys`: joint and spring of the keyboard.
  draw(keys: { joint: SceneJoint | null; spring: AppliedSpring | null }): void {
    const view = this.view();
    if (!view) return;
    const { held, handles } = this;
    const { stage, scene, frame } = view;
    const at = handles.showTip(stage, handles.tipPosition(view));
    const goal = held?.kind === 'tip' ? stage.project(...held.drag.goal.toArray()) : null;
    handles.showGoalLine(at, goal);
    const joint = this.joint ?? keys.joint;
    handles.showArc(stage, frame, joint, joint ? this.jointValue(view, joint) : 0, 0.2 * scene.view.radius);
    const spring = held?.kind === 'spring' ? { ...held, goal: held.drag.goal } : keys.spring;
    if (!spring) return handles.showSpring(null, null, '');
    const from = inWorld(frame.link, spring.body, spring.point);
    const newtons = channel(frame, scene, 'mouse_spring');
    const text = Number.isFinite(newtons) ? `${newtons.toFixed(1)} N` : '';
    const to = stage.project(...spring.goal.toArray());
    handles.showSpring(from && stage.project(...from.toArray()), to, text);
  }

  private pixel(event: { clientX: number; clientY: number }): Pixel {
    const { left, top } = this.host.getBoundingClientRect();
    return { x: event.clientX - left, y: event.clientY - top };
  }

  private isOnView(event: Event): boolean {
    return event.target instanceof HTMLCanvasElement || event.target === this.handles.tip;
  }

  private down(event: PointerEvent): void {
    const view = this.view();
    if (this.pinch.isPassing || !view || !this.isOnView(event)) return;
    if (event.button !== 0 || !event.isPrimary || event.altKey) return;
    const at = this.pixel(event);
    if (event.target === this.handles.tip) {
      const tip = this.handles.tipPosition(view);
      if (!tip || !this.operator.useSource('drag')) return;
      this.take(event, { kind: 'tip', drag: new PointDrag(view.stage, tip, at, tipPlane(view)) });
      return;
    }
    const found = this.find(view, at);
    if (found.kind === 'joint') {
      const { joint, point } = found;
      const axis = axisOf(view.frame, joint);
      if (!axis || !this.operator.useSource('joints')) return;
      const drag = new JointDrag(view.stage, axis, point, this.jointValue(view, joint), joint);
      this.take(event, { kind: 'joint', joint, drag });
    } else {
      const moves = found.hit && view.scene.bodies[found.hit.body]?.moves;
      const click = { kind: 'click', hit: found.hit, ...at } as const;
      if (moves) this.take(event, click);
      else this.held = click; // the camera handles a drag; a click selects
    }
  }

  private take(event: PointerEvent, held: Held): void {
    this.held = held;
    this.hint = held.kind === 'tip' ? HINTS.tipHeld : this.hint;
    this.view()!.stage.controls.enabled = false;
    this.host.setPointerCapture(event.pointerId);
    this.host.dataset.held = held.kind;
    if (held.kind === 'tip') this.handles.tip.focus({ preventScroll: true });
    event.preventDefault();
  }

  private move(event: PointerEvent): void {
    const { held } = this;
    const view = this.view();
    if (!held || !view) {
      this.hover = event;
      return;
    }
    const at = this.pixel(event);
    if (held.kind === 'click') return this.moveClick(view, held, at);
    if (held.kind === 'joint') {
      this.operator.move({ do: 'joint', index: held.joint.driven!, value: held.drag.move(at) });
      return this.on.changed();
    }
    held.drag.move(at, event.shiftKey);
    this.sendGoal(held);
  }

  private moveClick({ stage, frame }: DrawnView, held: Held & { kind: 'click' }, at: Pixel): void {
    if (Math.hypot(at.x - held.x, at.y - held.y) < START) return;
    this.held = null;
    const { hit } = held;
    if (!hit || stage.controls.enabled) return; // handled by the camera
    const point = inLink(frame.link, hit.body, hit.point);
    if (!point || !this.operator.requestControl()) return this.release();
    const drag = new PointDrag(stage, hit.point.clone(), held);
    this.held = { kind: 'spring', body: hit.body, point, drag };
    this.host.dataset.held = 'spring';
    this.hint = HINTS.springHeld;
    drag.move(at, false);
    this.sendGoal(this.held);
  }

  private wheel(event: WheelEvent): void {
    const { held } = this;
    if (held?.kind !== 'tip' && held?.kind !== 'spring') return;
    event.preventDefault();
    event.stopPropagation();
    held.drag.deepen(-0.0004 * event.deltaY);
    this.sendGoal(held);
  }

  private sendGoal(held: Held & { kind: 'tip' | 'spring' }): void {
    const goal = held.drag.goal.toArray();
    if (held.kind === 'tip') this.operator.move({ do: 'drag_stylus', goal });
    else this.operator.move({ do: 'drag_body', body: held.body, point: held.point, goal });
    this.on.changed();
  }

  private up(event: PointerEvent): void {
    const { held } = this;
    if (!held || !event.isPrimary) return;
    if (held.kind === 'click') this.on.select(held.hit?.body ?? null);
    if (held.kind === 'spring') this.operator.releaseSpring();
    this.release();
    this.hover = event;
  }

  // At a second finger. True: the camera did not get the first one. A drag of the ring continues.
  private cancel(): boolean {
    const { held } = this;
    const hasCamera = this.view()?.stage.controls.enabled ?? true;
    if (held?.kind === 'tip') return false;
    if (held?.kind === 'spring') this.operator.releaseSpring();
    this.release();
    return !hasCamera;
  }

  private release(): void {
    this.held = null;
    this.hint = HINTS.view;
    delete this.host.dataset.held;
    const view = this.view();
    if (view) view.stage.controls.enabled = true;
    this.on.changed();
  }

  // A link of the target robot counts only where it is clearly in front of the robot.
  private find({ stage, scene, frame }: DrawnView, at: Pixel) {
    const hit = pick(stage, frame, 0, at);
    const layer = scene.layers.findIndex(({ name }) => name === 'targets');
    const target = layer > 0 ? pick(stage, frame, layer, at) : null;
    const joint = target && scene.joints.find((j) => j.body === target.body && j.driven !== undefined && j.axis);
    if (joint && (!hit || target.distance < hit.distance - 0.03 * scene.view.radius))
      return { kind: 'joint', joint, point: target.point } as const;
    return { kind: 'body', hit } as const;
  }

  private look(event: PointerEvent): void {
    const view = this.view();
    if (!view || !this.isOnView(event)) return;
    const before = this.joint;
    this.joint = null;
    if (event.target === this.handles.tip) this.show('tip', HINTS.tip);
    else {
      const found = this.find(view, this.pixel(event));
      const body = found.kind === 'body' && found.hit ? view.scene.bodies[found.hit.body] : null;
      if (found.kind === 'joint') {
        this.joint = found.joint;
        this.show('joint', `drag: move joint ${found.joint.name} of the target robot`);
      } else if (body?.moves) this.show('spring', `drag: spring force on ${body.name} · click: select it`);
      else if (body) this.show('view', `click: select ${body.name} · ${HINTS.view}`);
      else this.show('view', HINTS.view);
    }
    if (before !== this.joint) this.on.changed();
  }

  private show(kind: Held['kind'] | 'view', hint: string): void {
    this.hint = hint;
    this.host.dataset.over = kind;
  }

  jointValue({ frame, scene }: LabView, joint: SceneJoint): number {
    if (this.held?.kind === 'joint' && this.held.joint === joint) return this.held.drag.value;
    const target = channel(frame, scene, 'target', joint.name);
    return Number.isFinite(target) ? target : channel(frame, scene, 'coordinate', joint.name);
  }
}

// Value of a channel; NaN: no such channel.
function channel(frame: Frame, scene: SceneMessage, kind: string, of?: string): number {
  const at = scene.channels.findIndex((c) => c.kind === kind && (of === undefined || c.of === of));
  return at < 0 ? NaN : frame.channels[at];
}
