// A game controller, through the browser. Left stick: right and toward; right stick: yaw and up;
// the pads roll and pitch; the first button is the gripper, the second the clutch.
import type { Operator } from './operator';

const DEAD = 0.12; // of a stick that rests

function stick(value: number): number {
  const size = Math.abs(value);
  return size < DEAD ? 0 : (Math.sign(value) * (size - DEAD)) / (1 - DEAD);
}

export class Controller {
  private resting = true;
  private readonly down = [false, false];

  constructor(private readonly hand: Operator, say: (words: string) => void) {
    addEventListener('gamepadconnected', ({ gamepad }) =>
      say(`${gamepad.id.split('(')[0].trim()}: sticks move the hand, the first button grips.`),
    );
  }

  // Once a picture.
  poll(): void {
    const pad = navigator.getGamepads?.().find((each) => each?.connected);
    if (!pad) return;
    const [x, y, yaw, up] = [0, 1, 2, 3].map((i) => stick(pad.axes[i] ?? 0));
    const held = (i: number) => pad.buttons[i]?.value ?? 0;
    const rates = [x, -up, y, -yaw, held(12) - held(13), held(15) - held(14)];
    const rests = rates.every((rate) => rate === 0);
    if (!this.resting || (!rests && this.hand.lead('drag'))) this.hand.move({ do: 'axes', rates });
    this.resting = rests;
    for (const index of [0, 1] as const) {
      const down = held(index) > 0.5;
      if (down !== this.down[index]) this.hand.button(index, down);
      this.down[index] = down;
    }
  }
}
