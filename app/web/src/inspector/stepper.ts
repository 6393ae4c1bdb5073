// The way of the passes: one button for each step, a row a pass.
import { button, element } from '../ui/dom';

export const PASSES: Record<number, [string, string]> = {
  1: ['Pass 1, outward', 'velocities, and the force that each body alone takes'],
  2: ['Pass 2, inward', 'articulated inertias: each body with all that hangs on it'],
  3: ['Pass 3, outward', 'accelerations'],
};

export interface Step {
  pass: number;
  body: string;
}

export class Stepper {
  readonly root = element('nav.stepper', { 'aria-label': 'steps of the passes' });
  private chips: HTMLButtonElement[] = [];
  private steps: readonly Step[] = [];
  private rows: HTMLElement[] = [];

  constructor(
    private readonly go: (step: number) => void,
    private readonly goPass: (pass: number) => void,
  ) {}

  set(steps: readonly Step[]): void {
    this.chips = steps.map(({ pass, body }, i) =>
      button(body, `pass ${pass} at ${body}`, () => this.go(i)),
    );
    this.steps = steps;
    this.rows = [1, 2, 3].map((pass) =>
      element(
        'div.row',
        button(PASSES[pass][0], PASSES[pass].join(': '), () => this.goPass(pass), 'pass'),
        ...this.chips.filter((_, i) => steps[i].pass === pass),
      ),
    );
    this.root.replaceChildren(...this.rows);
  }

  show(at: number): void {
    this.chips.forEach((chip, i) => {
      chip.setAttribute('aria-current', i === at ? 'step' : 'false');
      chip.classList.toggle('done', i < at);
    });
    const pass = this.steps[at]?.pass;
    this.rows.forEach((row, i) => row.classList.toggle('current', i + 1 === pass));
  }
}
