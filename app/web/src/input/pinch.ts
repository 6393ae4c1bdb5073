// Two fingers pan and zoom the view. The first one always comes earlier: its drag is cancelled, its
// rotation of the view is undone.
import type * as THREE from 'three';
import type { Stage } from '../view/stage';

const TOGETHER = 250; // [ms]

interface First {
  event: PointerEvent; // its newest
  at: number;
  eye: THREE.Vector3;
  target: THREE.Vector3;
}

export class Pinch {
  isPassing = false; // the first finger's event is being repeated for the camera
  private first: First | null = null;

  constructor(
    host: HTMLElement,
    private readonly stage: () => Stage | null,
    // True: the camera did not get the first finger.
    private readonly cancelDrag: () => boolean,
  ) {
    // Before the listeners of drag and camera.
    host.addEventListener('pointerdown', (event) => this.down(event), { capture: true });
    host.addEventListener('pointermove', (event) => this.move(event), { capture: true });
    for (const end of ['pointerup', 'pointercancel'] as const)
      host.addEventListener(end, (event) => this.up(event), { capture: true });
  }

  private down(event: PointerEvent): void {
    const stage = this.stage();
    if (this.isPassing || !stage || event.pointerType !== 'touch') return;
    const { first } = this;
    if (event.isPrimary) {
      const [eye, target] = [stage.camera.position.clone(), stage.controls.target.clone()];
      this.first = { event, at: event.timeStamp, eye, target };
      return;
    }
    this.first = null;
    if (!first || !(event.target instanceof HTMLCanvasElement)) return;
    if (event.timeStamp - first.at > TOGETHER) return;
    const wasDrag = this.cancelDrag();
    stage.camera.position.copy(first.eye);
    stage.controls.target.copy(first.target);
    stage.controls.update();
    if (wasDrag) this.pass(first.event, event.target);
  }

  private move(event: PointerEvent): void {
    if (this.first?.event.pointerId === event.pointerId) this.first.event = event;
  }
  private up(event: PointerEvent): void {
    if (this.first?.event.pointerId === event.pointerId) this.first = null;
  }

  private pass(event: PointerEvent, canvas: HTMLCanvasElement): void {
    const { pointerId, pointerType, isPrimary, clientX, clientY } = event;
    const init = { pointerId, pointerType, isPrimary, clientX, clientY, bubbles: true };
    this.isPassing = true;
    canvas.dispatchEvent(new PointerEvent('pointerdown', init));
    this.isPassing = false;
  }
}
