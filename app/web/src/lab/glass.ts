// The glass: an inspector that follows the selected body. The three passes with their numbers in
// the equations, the free-body diagram, contacts, ledger; and, while time stands still, a walk
// through one call of the algorithm.
import './glass.css';
import type { GlassNumbers } from '../data/glass';
import { balanceTable, wrenchColor } from '../ui/balance';
import { checkTable, checkWords } from '../ui/checks';
import { button, element, icon, short } from '../ui/dom';
import { listen } from '../ui/keys';
import { morph } from '../ui/morph';
import { PASSES, Stepper, type Step } from '../ui/stepper';
import type { GlassMessage, SceneMessage } from './link';
import { passCards, unitOf } from './glass_cards';
import { closing, diagram, type Plane } from './glass_diagram';
import { contactTables, jointTables, ledgerTable, neighbourCards, soFar } from './glass_tables';
import type { LabPage, Panel } from './panel';

const LENGTH = 0.38; // of the longest arrow, of what is seen

// The way of one call: outward, inward, outward.
function stepsOf(bodies: string[]): Step[] {
  const outward = (pass: number) => bodies.map((body) => ({ pass, body }));
  return [...outward(1), ...outward(2).reverse(), ...outward(3)];
}

class Glass implements Panel {
  readonly root = element('section', { class: 'glass', 'aria-label': 'inspector' });
  private readonly who = element('div', { class: 'heading' });
  private readonly stepper = new Stepper(
    (step) => this.go(step),
    (pass) => this.goPass(pass),
  );
  private readonly place = element('output', { class: 'place' });
  private readonly content = element('div', { class: 'content' });
  private steps: Step[] = [];
  private bodies: string[] = []; // from number 1 on
  private body = 1;
  private pass = 1;
  private seen = false;
  private plane: Plane | null = null;
  private newest: GlassNumbers | null = null;

  constructor(private readonly page: LabPage) {
    const walk = element(
      'div',
      { class: 'walk', role: 'group', 'aria-label': 'one call, step by step' },
      button(icon('back'), 'one step of the call back (,)', () => this.move(-1)),
      button(icon('on'), 'one step of the call on (.)', () => this.move(1)),
      this.place,
    );
    this.root.append(this.who, this.stepper.root, walk, this.content);
    this.content.addEventListener('click', (event) => this.click(event));
    const key = (keys: string, what: string, by: number) => ({
      keys: [keys],
      shown: keys,
      what,
      act: () => this.seen && this.move(by),
    });
    listen([key(',', 'one step of the call back', -1), key('.', 'one step of the call on', 1)]);
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

  onGlass(message: GlassMessage): void {
    const numbers = message as unknown as GlassNumbers;
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

  private move(by: number): void {
    this.go(Math.min(this.steps.length - 1, Math.max(0, this.at + by)));
  }

  private go(step: number): void {
    const { pass, body } = this.steps[step];
    this.pass = pass;
    this.body = this.bodies.indexOf(body) + 1;
    this.show();
    if (this.page.selected !== this.body) this.page.select(this.body); // and comes back by onSelect
    else if (this.newest && this.seen) this.render(this.newest);
  }

  private goPass(pass: number): void {
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

  private render(numbers: GlassNumbers): void {
    const made = element('div', { class: 'content' }, ...this.sections(numbers));
    morph(this.content, made);
    const { name, t, stands, passes } = numbers;
    const joint = passes?.[0]?.joint;
    const parent = numbers.neighbours?.find(({ is }) => is === 'parent')?.body ?? 'the world';
    const when = stands ? 'time stands still' : 'stop the time to walk through the call';
    this.who.replaceChildren(
      element('h2', {}, name ?? ''),
      element('p', {}, `${joint ? `carried by ${joint}` : 'stands'} on ${parent}`),
      element('p', {}, `${short(t)} s: ${when}`),
    );
    this.root.classList.toggle('stands', stands);
    this.showForces(numbers);
  }

  private sections(numbers: GlassNumbers): Node[] {
    const { name = '', passes, balance, forces = [], ledger, checks, warnings = [] } = numbers;
    const notes = warnings.map((text) => element('p', { class: 'note' }, text));
    if (!passes || !balance) return notes;
    const { axes = 'world', about = 'origin', joint_balance = [], neighbours = [] } = numbers;
    const fold = (title: string, open: boolean, ...inside: Node[]) => {
      const made = element('details', {}, element('summary', {}, title), ...inside);
      made.open = open;
      return made;
    };
    const contacts = contactTables(forces, name);
    const taken = neighbourCards(neighbours, this.pass);
    const rows = numbers.rows?.filter(({ pass }) => pass === this.pass) ?? [];
    const checked = checks?.length ? checkWords(checks) : 'while time stands still';
    // Always the same parts in the same places: morph() goes by them.
    return [
      element('div', {}, ...notes),
      element('div', { class: 'so-far' }, ...(rows.length > 0 ? [soFar(rows, name)] : [])),
      element('h3', {}, PASSES[this.pass][0], element('span', {}, ` ${PASSES[this.pass][1]}`)),
      element('div', { class: 'cards' }, ...passCards(numbers, this.pass)),
      fold('From its neighbours', false, ...(taken.length ? taken : [words('nothing in this pass')])),
      fold(
        'Free body',
        true,
        diagram(balance[0], this.plane),
        words(closing(balance[0])),
        element('div', { class: 'wide wrenches' }, balanceTable(balance[0], axes, about)),
        ...jointTables(joint_balance, unitOf(numbers, 'N m; N')),
      ),
      fold(
        `Contacts: ${contacts.length || 'none'}`,
        true,
        ...(contacts.length ? contacts : [words('nothing touches it')]),
      ),
      fold('Ledger of energy, of all bodies', false, ledgerTable(ledger ?? {})),
      fold(`Checks: ${checked}`, false, checkTable(checks ?? [], [])),
    ];
  }

  // The forces on the body, from the point about which torques are taken; where time goes on they
  // would lag behind.
  private showForces({ stands, balance, axes }: GlassNumbers): void {
    const found = stands && axes === 'world' ? balance?.[0] : undefined;
    if (!found || !this.page.scene) return this.page.arrows('glass', []);
    const lengths = found.wrenches.map(({ force }) => Math.hypot(...force));
    const most = Math.max(...lengths.filter(Number.isFinite), 1e-300);
    const scale = (LENGTH * this.page.scene.view.radius) / most;
    this.page.arrows(
      'glass',
      found.wrenches.map(({ force }, i) => ({
        from: found.about as [number, number, number],
        along: force.map((part) => scale * part) as [number, number, number],
        color: wrenchColor(i),
      })),
    );
  }
}

function words(text: string): HTMLElement {
  return element('p', { class: 'hint' }, text);
}

export function glassOf(page: LabPage): Panel {
  return new Glass(page);
}
