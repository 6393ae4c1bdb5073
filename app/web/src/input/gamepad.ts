// Game controller, mapped as by JoystickDecoder (app/device/gesture_device.h). Left stick: right and up; right
// stick: yaw and toward; triggers or directional pad: roll; pad: pitch; first button: gripper, second: clutch.
import type { Operator } from './operator';

const DEAD_ZONE = 0.12;

function stick(value: number): number {
  const size = Math.abs(value);
  return size < DEAD_ZONE ? 0 : (Math.sign(value) * (size - DEAD_ZONE)) / (1 - DEAD_ZONE);
}

export class Controller {
  private isIdle = true;
  private readonly down = [false, false];

  constructor(private readonly operator: Operator, showMessage: (text: string) => void) {
    const words = 'sticks move the end effector, first button: gripper.';
    addEventListener('gamepadconnected', ({ gamepad: { id } }) => showMessage(`${id.split('(')[0].trim()}: ${words}`));
  }

  // Once per picture.
  poll(): void {
    const pad = navigator.getGamepads?.().find((each) => each?.connected);
    if (!pad) return;
    const [x, down, yaw, toward] = [0, 1, 2, 3].map((i) => stick(pad.axes[i] ?? 0));
    const held = (i: number) => pad.buttons[i]?.value ?? 0;
    const clockwise = Math.max(-1, Math.min(1, held(7) - held(6) + held(15) - held(14)));
    const rates = [x, -down, toward, yaw, held(12) - held(13), -clockwise];
    const isIdle = rates.every((rate) => rate === 0);
    if (!this.isIdle || (!isIdle && this.operator.useSource('drag'))) this.operator.move({ do: 'axes', rates });
    this.isIdle = isIdle;
    for (const index of [0, 1] as const) {
      const down = held(index) > 0.5;
      if (down !== this.down[index]) this.operator.button(index, down);
      this.down[index] = down;
    }
  }
}
