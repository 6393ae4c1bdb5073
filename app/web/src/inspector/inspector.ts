// The inspector follows the selected body. The three passes with their numbers in
// the equations, the free-body diagram, contacts, ledger; and, while time stands still, a walk
// through one call of the algorithm.
import './inspector.css';
import type { BodyInspection, Vector } from '../protocol/messages';
import {
  balanceTable, checkTable, checkWords, contactTables, energyTable, jointTables, neighbourCards, soFar,
  wrenchColor,
} from './tables';
import { button, element, icon, morph, short } from '../ui/dom';
import { key, listen } from '../ui/keys';
import type { SceneMessage } from '../source/link';
import { passCards, unitOf } from './cards';
import { closing, diagram, type Plane } from './diagram';
import type { LabPage, Panel } from '../panels/panel';

const LENGTH = 0.38; // of the longest arrow, of what is seen

// The way of one call: outward, inward, outward.
function stepsOf(bodies: string[]): Step[] {
  const outward = (pass: number) => bodies.map((body) => ({ pass, body }));
  return [...outward(1), ...outward(2).reverse(), ...outward(3)];
}

// What it needs of a page.
export type InspectorPage = Pick<LabPage, 'scene' | 'selected' | 'send' | 'select' | 'arrows'>;

export class Inspector implements Panel {
  readonly root = element('section.glass', { 'aria-label': 'inspector' });
  private readonly who = element('div.heading');
  private readonly stepper = new Stepper((step) => this.go(step), (pass) => this.goPass(pass));
  private readonly place = element('output.place');
  private readonly content = element('div.content');
  private steps: Step[] = [];
  private bodies: string[] = []; // from number 1 on
  private body = 1;
  private pass = 1;
  private seen = false;
  private plane: Plane | null = null;
  private newest: BodyInspection | null = null;

  constructor(private readonly page: InspectorPage) {
    const walk = element(
      'div.walk',
      { role: 'group', 'aria-label': 'one call, step by step' },
      button(icon('back'), 'one step of the call back (,)', () => this.move(-1)),
      button(icon('on'), 'one step of the call on (.)', () => this.move(1)),
      this.place,
    );
    this.root.append(this.who, this.stepper.root, walk, this.content);
    this.content.addEventListener('click', (event) => this.click(event));
    const move = (by: number) => () => this.seen && this.move(by);
    listen([key(', .', 'one step of the call back, on', { ',': move(-1), '.': move(1) })]);
    // Nobody looks: nothing is asked for.
    new IntersectionObserver((entries) => {
      const seen = entries.some((entry) => entry.isIntersecting);
      if (seen === this.seen) return;
      this.seen = seen;
      this.ask();
      if (!seen) this.page.arrows('glass', []);
    }).observe(this.root);
    if (page.scene) this.onScene(page.scene);
  }

  onScene(scene: SceneMessage): void {
    this.bodies = scene.bodies.slice(1).map(({ name }) => name);
    this.steps = stepsOf(this.bodies);
    this.stepper.set(this.steps);
    this.newest = null;
    this.content.replaceChildren();
    const robot = scene.bodies.findIndex(({ moves, robot }) => moves && robot);
    this.onSelect(this.page.selected ?? Math.max(1, robot));
  }

  onSelect(body: number | null): void {
    if (body !== null && body > 0 && body <= this.bodies.length) this.body = body;
    this.show();
    this.ask();
  }

  onGlass(numbers: BodyInspection): void {
    if (this.page.scene && numbers.scene !== this.page.scene.scene) return;
    this.newest = numbers;
    if (this.seen) this.render(numbers);
  }

  onTheme(): void {
    if (this.seen && this.newest) this.showForces(this.newest);
  }

  // The step of the walk that is shown.
  get state() {
    return { pass: this.pass, body: this.bodies[this.body - 1], step: this.at + 1 };
  }

  private get at(): number {
    const name = this.bodies[this.body - 1];
    return this.steps.findIndex(({ pass, body }) => pass === this.pass && body === name);
  }

  private ask(): void {
    if (this.bodies.length === 0) return;
    if (this.seen) this.page.send({ do: 'glass', on: true, body: this.body });
    else this.page.send({ do: 'glass', on: false });
  }

  move(by: number): void {
    this.go(this.at + by);
  }

  // To a step of the call, or the nearest one.
  go(step: number): void {
    const { pass, body } = this.steps[Math.min(this.steps.length - 1, Math.max(0, step || 0))];
    this.pass = pass;
    this.body = this.bodies.indexOf(body) + 1;
    this.show();
    if (this.page.selected !== this.body) this.page.select(this.body); // and comes back by onSelect
    else if (this.newest && this.seen) this.render(this.newest);
  }

  goPass(pass: number): void {
    this.pass = pass;
    this.show();
    if (this.newest && this.seen) this.render(this.newest);
  }

  private click(event: Event): void {
    const at = (event.target as Element).closest<HTMLElement>('[data-plane], [data-body]');
    if (!at) return;
    if (at.dataset.plane) {
      this.plane = at.dataset.plane as Plane;
      if (this.newest) this.render(this.newest);
      return;
    }
    const body = at.dataset.body!;
    this.go(this.steps.findIndex((step) => step.pass === this.pass && step.body === body));
  }

  private show(): void {
    this.stepper.show(this.at);
    this.place.textContent = `step ${this.at + 1} of ${this.steps.length}`;
  }

  private render(numbers: BodyInspection): void {
    const made = element('div.content', ...this.sections(numbers));
    morph(this.content, made);
    const { name, t, stands, passes, neighbours } = numbers;
    const joint = passes?.[0]?.joint;
    const parent = neighbours?.find(({ is }) => is === 'parent')?.body ?? 'the world';
    const on = neighbours ? ` on ${parent}` : '';
    const when = stands ? 'time stands still' : 'stop the time to walk through the call';
    const time = t === undefined ? [] : [element('p', `${short(t)} s: ${when}`)];
    this.who.replaceChildren(
      element('h2', name ?? ''),
      element('p', `${joint ? `carried by ${joint}` : 'stands'}${on}`),
      ...time,
    );
    this.root.classList.toggle('stands', stands);
    this.showForces(numbers);
  }

  private sections(numbers: BodyInspection): Node[] {
    const { name = '', passes, balance, forces = [], ledger, checks, stands, warnings = [] } = numbers;
    const notes = warnings.map((text) => element('p.note', text));
    if (!passes || !balance) return notes;
    const { axes = 'world', about = 'origin', joint_balance = [], neighbours = [] } = numbers;
    const fold = (title: string, open: boolean, ...inside: Node[]) => {
      const made = element('details', element('summary', title), ...inside);
      made.open = open;
      return made;
    };
    const contacts = contactTables(forces, name);
    const taken = neighbourCards(neighbours, this.pass);
    const rows = numbers.rows?.filter(({ pass }) => pass === this.pass) ?? [];
    const checked = checks?.length ? checkWords(checks) : 'while time stands still';
    // Always the same parts in the same places: morph() goes by them.
    return [
      element('div', ...notes),
      element('div.so-far', ...(rows.length > 0 ? [soFar(rows, name)] : [])),
      element('h3', PASSES[this.pass][0], element('span', ` ${PASSES[this.pass][1]}`)),
      element('div.cards', ...passCards(numbers, this.pass)),
      ...(numbers.neighbours ? [fold('From its neighbours', false, ...orWords(taken, 'nothing in this pass'))] : []),
      fold(
        'Free body',
        true,
        ...balance.flatMap((forces) => [
          diagram(forces, this.plane),
          words(closing(forces)),
          element('div.wide.wrenches', balanceTable(forces, axes, about)),
        ]),
        ...jointTables(joint_balance, unitOf(numbers, 'N m; N')),
      ),
      fold(`Contacts: ${contacts.length || 'none'}`, true, ...orWords(contacts, 'nothing touches it')),
      ...(ledger ? [fold('Ledger of energy, of all bodies', false, energyTable(ledger))] : []),
      ...(checks || !stands ? [fold(`Checks: ${checked}`, false, checkTable(checks ?? [], []))] : []),
    ];
  }

  // The forces on the body, from the point about which torques are taken; where time goes on they
  // would lag behind.
  private showForces({ stands, balance, axes }: BodyInspection): void {
    const found = stands && axes === 'world' ? balance?.[0] : undefined;
    if (!found || !this.page.scene) return this.page.arrows('glass', []);
    const lengths = found.wrenches.map(({ force }) => Math.hypot(...force));
    const most = Math.max(...lengths.filter(Number.isFinite), 1e-300);
    const scale = (LENGTH * this.page.scene.view.radius) / most;
    const arrows = found.wrenches.map(({ force }, i) => ({
      from: found.about as Vector,
      along: force.map((part) => scale * part) as Vector,
      color: wrenchColor(i),
    }));
    this.page.arrows('glass', arrows);
  }
}

function orWords(parts: Node[], text: string): Node[] {
  return parts.length > 0 ? parts : [words(text)];
}
function words(text: string): HTMLElement {
  return element('p.hint', text);
}

// The way of the passes: one button for each step, a row a pass.
export const PASSES: Record<number, [string, string]> = {
  1: ['Pass 1, outward', 'velocities, and the force that each body alone takes'],
  2: ['Pass 2, inward', 'articulated inertias: each body with all that hangs on it'],
  3: ['Pass 3, outward', 'accelerations'],
};

export type Step = { pass: number; body: string };

export class Stepper {
  readonly root = element('nav.stepper', { 'aria-label': 'steps of the passes' });
  private chips: HTMLButtonElement[] = [];
  private steps: readonly Step[] = [];
  private rows: HTMLElement[] = [];

  constructor(private readonly go: (step: number) => void, private readonly goPass: (pass: number) => void) {}

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
