// The inspector of the selected body: quantities of the three ABA passes with their equations, free-body
// diagram, contacts, energy balance; while paused, a walk through one call of the algorithm.
import './inspector.css';
import type { BodyInspection, Vector } from '../protocol/messages';
import { adjacentCards, balanceTable, checkSummary, checkTable, contactTables, energyTable, jointTables, passTable } from './tables';
import { button, definition, element, icon, morph, short } from '../ui/dom';
import { key, listen } from '../ui/keys';
import { token } from '../ui/preferences';
import type { SceneMessage } from '../source/link';
import { passCards } from './cards';
import { closing, diagram, type Plane } from './diagram';
import type { LabPage, Panel } from '../panels/panel';

const LENGTH = 0.38; // of the longest arrow, relative to the size of the scene
const PASSES: Record<number, [string, string]> = {
  1: ['Pass 1, outward', 'velocities v, velocity-product accelerations c, bias forces p'],
  2: ['Pass 2, inward', 'articulated-body inertias IA and bias forces pA'],
  3: ['Pass 3, outward', 'joint and body accelerations qdd, a'],
};

type Step = { pass: number; body: string };

export type InspectorPage = Pick<LabPage, 'scene' | 'selected' | 'send' | 'select' | 'arrows'>;

export class Inspector implements Panel {
  readonly root = element('section.inspector', { 'aria-label': 'inspector' });
  private readonly heading = element('div.heading');
  // One button per step, one row per pass.
  private readonly stepper = element('nav.stepper', { 'aria-label': 'steps of the passes' });
  private chips: HTMLButtonElement[] = [];
  private rows: HTMLElement[] = [];
  private readonly place = element('output.place');
  private readonly content = element('div.content', { click: (event: Event) => this.click(event) });
  private steps: Step[] = []; // of one call
  private bodies: string[] = []; // from number 1 on
  private body = 1;
  private pass = 1;
  private isSeen = false;
  private plane: Plane | null = null;
  private newest: BodyInspection | null = null;

  constructor(private readonly page: InspectorPage) {
    const walk = element(
      'div.walk.fine',
      { role: 'group', 'aria-label': 'one call, step by step' },
      button(icon('back'), 'previous step of the call (,)', () => this.move(-1)),
      button(icon('on'), 'next step of the call (.)', () => this.move(1)),
      this.place,
    );
    this.root.append(this.heading, this.stepper, walk, this.content);
    const move = (by: number) => () => this.isSeen && this.move(by);
    listen([key(', .', 'previous, next step of the call', { ',': move(-1), '.': move(1) })]);
    // Requests data only while visible.
    new IntersectionObserver((entries) => {
      const isSeen = entries.some((entry) => entry.isIntersecting);
      if (isSeen === this.isSeen) return;
      this.isSeen = isSeen;
      this.request();
      if (!isSeen) this.page.arrows([]);
    }).observe(this.root);
    if (page.scene) this.onScene(page.scene);
  }

  onScene(scene: SceneMessage): void {
    this.bodies = scene.bodies.slice(1).map(({ name }) => name);
    const outward = (pass: number) => this.bodies.map((body) => ({ pass, body }));
    this.steps = [...outward(1), ...outward(2).reverse(), ...outward(3)];
    this.fillStepper();
    this.newest = null;
    this.content.replaceChildren();
    const robot = scene.bodies.findIndex(({ moves, robot }) => moves && robot);
    this.onSelect(this.page.selected ?? Math.max(1, robot));
  }

  private fillStepper(): void {
    this.chips = this.steps.map(({ pass, body }, i) => button(body, `pass ${pass} at ${body}`, () => this.go(i)));
    this.rows = [1, 2, 3].map((pass) =>
      element(
        'div.row',
        button(PASSES[pass][0], PASSES[pass].join(': '), () => this.goPass(pass), 'pass'),
        ...this.chips.filter((_, i) => this.steps[i].pass === pass),
      )
    );
    this.stepper.replaceChildren(...this.rows);
  }

  onSelect(body: number | null): void {
    if (body !== null && body > 0 && body <= this.bodies.length) this.body = body;
    this.show();
    this.request();
  }

  onInspection(numbers: BodyInspection): void {
    if (this.page.scene && numbers.scene !== this.page.scene.scene) return;
    this.newest = numbers;
    this.refresh();
  }

  onTheme(): void {
    if (this.isSeen && this.newest) this.showForces(this.newest);
  }

  get state() {
    return { pass: this.pass, body: this.bodies[this.body - 1], step: this.at + 1 };
  }

  private get at(): number {
    const name = this.bodies[this.body - 1];
    return this.steps.findIndex(({ pass, body }) => pass === this.pass && body === name);
  }

  private request(): void {
    if (this.bodies.length === 0) return;
    this.page.send(this.isSeen ? { do: 'inspect', on: true, body: this.body } : { do: 'inspect', on: false });
  }

  move(by: number): void {
    this.go(this.at + by);
  }

  // To the nearest step of the call.
  go(step: number): void {
    const { pass, body } = this.steps[Math.min(this.steps.length - 1, Math.max(0, step || 0))];
    this.pass = pass;
    this.body = this.bodies.indexOf(body) + 1;
    this.show();
    if (this.page.selected !== this.body) this.page.select(this.body); // which calls onSelect
    else this.refresh();
  }

  goPass(pass: number): void {
    this.pass = pass;
    this.show();
    this.refresh();
  }

  private click(event: Event): void {
    const at = (event.target as Element).closest<HTMLElement>('[data-plane], [data-body]');
    if (!at) return;
    const { plane, body } = at.dataset;
    if (!plane) return this.go(this.steps.findIndex((step) => step.pass === this.pass && step.body === body));
    this.plane = plane as Plane;
    this.refresh();
  }

  private show(): void {
    this.chips.forEach((chip, i) => chip.setAttribute('aria-current', i === this.at ? 'step' : 'false'));
    this.rows.forEach((row, i) => row.classList.toggle('current', i + 1 === this.pass));
    this.place.textContent = `step ${this.at + 1} of ${this.steps.length}`;
  }

  private refresh(): void {
    if (!this.newest || !this.isSeen) return;
    const numbers = this.newest;
    morph(this.content, element('div.content', ...this.sections(numbers)));
    const { name, t, paused, passes, neighbours } = numbers;
    const joint = passes?.[0]?.joint;
    const parent = neighbours?.find(({ is }) => is === 'parent')?.body ?? 'world';
    const state = paused ? 'paused' : 'pause to step through the algorithm';
    this.heading.replaceChildren(
      element('h2', name ?? ''),
      element('p.fine', `${joint ? `joint: ${joint}` : 'fixed'}${neighbours ? ` · parent: ${parent}` : ''}`),
      ...(t === undefined ? [] : [element('p.fine', `${short(t)} s: ${state}`)]),
    );
    this.root.classList.toggle('paused', paused);
    this.showForces(numbers);
  }

  private sections(numbers: BodyInspection): Node[] {
    const { name = '', passes, balance, forces = [], energy_balance, checks, paused, warnings = [] } = numbers;
    const notes = warnings.map((text) => element('p.note', text));
    if (!passes || !balance) return notes;
    const { axes = 'world', about = 'origin', joint_balance = [], neighbours } = numbers;
    const fold = (title: string, open: boolean, ...inside: Node[]) => {
      const made = element('details', element('summary', { title: definition(title) }, title), ...inside);
      made.open = open;
      return made;
    };
    const contacts = contactTables(forces, name);
    const adjacent = adjacentCards(neighbours ?? [], this.pass);
    const rows = numbers.rows?.filter(({ pass }) => pass === this.pass) ?? [];
    const checked = checks?.length ? checkSummary(checks) : 'while paused';
    const [title, contents] = PASSES[this.pass];
    // Always the same parts in the same order, as morph() matches them.
    return [
      element('div', ...notes),
      element('div.pass-table', ...(rows.length > 0 ? [passTable(rows, name)] : [])),
      element('h3', title, element('span', ` ${contents}`)),
      element('div.cards', ...passCards(numbers, this.pass)),
      ...(neighbours ? [fold('Parent and children', false, ...orHint(adjacent, 'none in this pass'))] : []),
      fold(
        'Free-body diagram',
        true,
        ...balance.flatMap((forces) => [
          diagram(forces, this.plane),
          element('p.hint', closing(forces)),
          element('div.wide.wrenches', balanceTable(forces, axes, about)),
        ]),
        ...jointTables(joint_balance),
      ),
      fold(`Contacts: ${contacts.length || 'none'}`, true, ...orHint(contacts, 'no contact')),
      ...(energy_balance ? [fold('Energy balance of all bodies', false, energyTable(energy_balance))] : []),
      ...(checks || !paused ? [fold(`Cross-checks: ${checked}`, false, checkTable(checks ?? [], []))] : []),
    ];
  }

  // Arrows of the forces, from the point about which torques are taken; only while paused, since the
  // inspection is older than the frame.
  private showForces({ paused, balance, axes }: BodyInspection): void {
    const found = paused && axes === 'world' ? balance?.[0] : undefined;
    if (!found || !this.page.scene) return this.page.arrows([]);
    const lengths = found.wrenches.map(({ force }) => Math.hypot(...force));
    const max = Math.max(...lengths.filter(Number.isFinite), 1e-300);
    const scale = (LENGTH * this.page.scene.view.radius) / max;
    const arrows = found.wrenches.map(({ force }, i) => ({
      from: found.about as Vector,
      along: force.map((part) => scale * part) as Vector,
      color: token(`--c${i % 8}`),
    }));
    this.page.arrows(arrows);
  }
}

const orHint = (parts: Node[], text: string): Node[] => (parts.length > 0 ? parts : [element('p.hint', text)]);
