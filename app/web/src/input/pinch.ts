// Two fingers move and zoom the view, whatever the first has touched. They never come at the same
// instant: what the first has grabbed meanwhile is let go, and what it has turned is turned back.
import * as THREE from 'three';
import type { Stage } from '../view/stage';

const TOGETHER = 250; // [ms]

interface First {
  event: PointerEvent; // the newest of it
  at: number;
  eye: THREE.Vector3;
  target: THREE.Vector3;
}

export class Pinch {
  private first: First | null = null;
  private passing = false;

  constructor(
    host: HTMLElement,
    private readonly stage: () => Stage | null,
    // True: it had been grabbed, so that the camera does not know of it.
    private readonly letGo: () => boolean,
  ) {
    // Before those who grab and turn.
    host.addEventListener('pointerdown', (event) => this.down(event), { capture: true });
    host.addEventListener('pointermove', (event) => this.move(event), { capture: true });
    for (const end of ['pointerup', 'pointercancel'] as const)
      host.addEventListener(end, (event) => this.up(event), { capture: true });
  }

  // The first finger comes once more, for the camera alone.
  isPassing(): boolean {
    return this.passing;
  }

  private down(event: PointerEvent): void {
    const stage = this.stage();
    if (this.passing || !stage || event.pointerType !== 'touch') return;
    const { first } = this;
    if (event.isPrimary) {
      const [eye, target] = [stage.camera.position.clone(), stage.controls.target.clone()];
      this.first = { event, at: event.timeStamp, eye, target };
      return;
    }
    this.first = null;
    if (!first || !(event.target instanceof HTMLCanvasElement)) return;
    if (event.timeStamp - first.at > TOGETHER) return;
    const wasGrabbed = this.letGo();
    stage.camera.position.copy(first.eye);
    stage.controls.target.copy(first.target);
    stage.controls.update();
    if (wasGrabbed) this.pass(first.event, event.target);
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
    this.passing = true;
    canvas.dispatchEvent(new PointerEvent('pointerdown', init));
    this.passing = false;
  }
}
