// The page of one inspected state: the passes of the articulated-body algorithm, body by body, with
// the robot beside them.
import './style.css';
import './inspect.css';
import type { Balance, InspectedRobot, Inspection, PassStep } from './data/inspection';
import { button, element, icon, short } from './ui/dom';
import { help, listen, type Key } from './ui/keys';
import { LayerChoice } from './ui/layers';
import { onPaper } from './ui/paper';
import { quantityCard } from './ui/quantity';
import { start } from './ui/start';
import { Tabs } from './ui/tabs';
import { Theme, token } from './ui/theme';
import { Labels } from './view/labels';
import { Stage, type ViewName } from './view/stage';

const PASSES: Record<number, [string, string]> = {
  1: ['Pass 1, outward', 'velocities, and the force that each body alone takes'],
  2: ['Pass 2, inward', 'articulated inertias: each body with all that hangs on it'],
  3: ['Pass 3, outward', 'accelerations'],
};
const FAINT = 60; // of 255: bodies that are not looked at

class Page {
  private at = 0;
  private stale = true;
  private readonly steps: PassStep[];
  private readonly chips: HTMLButtonElement[] = [];
  private readonly host = element('div', { class: 'stage' });
  private readonly heading = element('div', { class: 'heading', 'aria-live': 'polite' });
  private readonly cards = element('div', { class: 'cards' });
  private readonly balance = element('section', { class: 'balance' });
  private readonly stage: Stage;
  private readonly labels: Labels;
  private readonly layers: LayerChoice;
  private readonly theme: Theme;

  constructor(private readonly robot: InspectedRobot) {
    this.steps = robot.inspection.passes;
    this.theme = new Theme(() => this.stage?.setTheme(this.theme.dark));
    const overlays = robot.layers.filter((layer) => !layer.name.startsWith('body/'));
    this.layers = new LayerChoice(overlays, () => (this.stale = true));
    this.build();
    this.stage = new Stage(this.host, robot.view, robot, () => (this.stale = true));
    this.labels = new Labels(this.host.querySelector('.labels')!);
    const asked = new URLSearchParams(location.hash.slice(1));
    const theme = asked.get('theme');
    if (theme) this.theme.set(theme === 'dark');
    this.stage.setTheme(this.theme.dark);
    this.go(Number(asked.get('step') ?? 1) - 1);
    onPaper(this.host, () => {
      this.stage.resize();
      this.paint();
    });
    const tick = () => {
      if (this.stale) this.paint();
      requestAnimationFrame(tick);
    };
    tick();
  }

  get state() {
    const { pass, body } = this.steps[this.at];
    return { step: this.at + 1, pass, body };
  }

  private build(): void {
    const { robot } = this;
    const keys = this.keys();
    const dialog = help(keys);
    keys.find((key) => key.shown === '?')!.act = () =>
      dialog.open ? dialog.close() : dialog.showModal();
    const views = (['start', 'front', 'side', 'top'] as ViewName[]).map((name) =>
      button(name === 'start' ? 'fit' : name, `look from: ${name}`, () => this.stage.look(name)),
    );
    this.host.append(
      element('div', { class: 'labels', 'aria-hidden': 'true' }),
      this.layers.switches,
      this.layers.legend,
      element('div', { class: 'views' }, ...views),
    );
    const tabs = new Tabs();
    tabs.add('Passes', this.stepper(), this.heading, this.cards, this.balance);
    const checks = robot.inspection.checks;
    const failed = checks.filter((check) => !check.pass).length;
    const words = failed > 0 ? `${failed} of ${checks.length} fall short` : `${checks.length} pass`;
    tabs.add(`Checks: ${words}`, this.checkTable());
    document.body.append(
      element(
        'header',
        {},
        element('h1', {}, robot.title),
        element('p', {}, robot.state.replaceAll('\n', ' · ')),
        button('?', 'keys (?)', () => dialog.showModal()),
        button(icon('theme'), 'light or dark (t)', () => this.theme.set(!this.theme.dark)),
      ),
      element('main', { class: 'inspect' }, this.host, tabs.root),
      element(
        'footer',
        { class: 'transport' },
        button(icon('back'), 'one step back (←)', () => this.go(this.at - 1)),
        button(icon('on'), 'one step on (→)', () => this.go(this.at + 1)),
        element('code', { id: 'command' }, robot.command),
        element('span', { class: 'frame' }, `twinarm ${robot.version}`),
      ),
      dialog,
    );
    listen(keys);
  }

  // The way of the passes, one button a body.
  private stepper(): HTMLElement {
    const rows = [1, 2, 3].map((pass) => {
      const row = element('div', { class: 'row' }, element('span', {}, PASSES[pass][0]));
      this.steps.forEach((step, i) => {
        if (step.pass !== pass) return;
        const chip = button(step.body, `pass ${pass} at ${step.body}`, () => this.go(i));
        this.chips[i] = chip;
        row.append(chip);
      });
      return row;
    });
    return element('nav', { class: 'stepper', 'aria-label': 'steps of the passes' }, ...rows);
  }

  private go(step: number): void {
    this.at = Math.min(this.steps.length - 1, Math.max(0, step || 0));
    const { pass, body, joint, quantities } = this.steps[this.at];
    this.chips.forEach((chip, i) =>
      chip.setAttribute('aria-current', i === this.at ? 'step' : 'false'),
    );
    this.heading.replaceChildren(
      element('h2', {}, body),
      element('p', {}, `${PASSES[pass].join(': ')}. Carried by ${joint || 'the base'}.`),
    );
    // Matrices at the left, what is smaller beside them.
    const cards = quantities.map(quantityCard);
    const column = (matrices: boolean) =>
      element('div', {}, ...cards.filter((card) => !!card.querySelector('.heat') === matrices));
    const columns = [column(true), column(false)].filter((c) => c.children.length > 0);
    this.cards.classList.toggle('two', columns.length === 2);
    this.cards.replaceChildren(...columns);
    const balance = this.robot.inspection.balance.find((b) => b.body === body);
    this.balance.replaceChildren(...(balance ? [this.balanceTable(balance)] : []));
    this.stale = true;
  }

  private balanceTable(balance: Balance): HTMLElement {
    const { axes, about } = this.robot.inspection;
    const numbers = (values: number[]) =>
      values.map((value) => element('td', { class: 'number', title: String(value) }, short(value)));
    const rows = balance.wrenches.map((wrench, i) =>
      element(
        'tr',
        {},
        element('th', { scope: 'row' }, swatch(i), wrench.source),
        ...numbers(wrench.force),
        ...numbers(wrench.torque),
      ),
    );
    const heads = ['', 'Fx', 'Fy', 'Fz [N]', 'Tx', 'Ty', 'Tz [N m]'];
    const { residual, largest } = balance;
    const sum = `They add up to ${short(residual)} of the largest (${short(largest)}).`;
    return element(
      'div',
      {},
      element(
        'h3',
        {},
        `Every wrench on ${balance.body}`,
        element('span', {}, ` ${axes} axes, about ${about}`),
      ),
      element(
        'table',
        {},
        element('thead', {}, element('tr', {}, ...heads.map((head) => element('th', {}, head)))),
        element('tbody', {}, ...rows),
      ),
      element('p', { class: 'hint' }, sum),
    );
  }

  private checkTable(): HTMLElement {
    const heads = ['', 'found by a second way', 'error', 'tolerance', 'worst at'];
    const rows = this.robot.inspection.checks.map((check) =>
      element(
        'tr',
        { class: check.pass ? 'passes' : 'short' },
        element('th', { scope: 'row' }, `${check.pass ? '✓' : '✗'} ${check.name}`),
        element('td', {}, check.meaning),
        element('td', { class: 'number', title: String(check.error) }, short(check.error)),
        element('td', { class: 'number' }, short(check.tolerance)),
        element('td', {}, check.body),
      ),
    );
    const table = element(
      'table',
      {},
      element('thead', {}, element('tr', {}, ...heads.map((head) => element('th', {}, head)))),
      element('tbody', {}, ...rows),
    );
    const notes = this.robot.inspection.warnings.map((text) =>
      element('p', { class: 'note' }, text),
    );
    return element('section', { class: 'checks' }, ...notes, table);
  }

  private keys(): Key[] {
    const key = (keys: string[], shown: string, what: string, act: () => void): Key => ({
      keys,
      shown,
      what,
      act,
    });
    const pass = (number: number) => () =>
      this.go(this.steps.findIndex((step) => step.pass === number));
    const orbit = (around: number, up: number, closer: number) => () =>
      this.stage.orbit(around, up, closer);
    return [
      key(['ArrowRight', ' '], '→', 'the next body', () => this.go(this.at + 1)),
      key(['ArrowLeft'], '←', 'the body before', () => this.go(this.at - 1)),
      key(['1'], '1, 2, 3', 'to that pass', pass(1)),
      key(['2'], '', '', pass(2)),
      key(['3'], '', '', pass(3)),
      key(['a'], 'a, d', 'turn the view', orbit(-0.1, 0, 1)),
      key(['d'], '', '', orbit(0.1, 0, 1)),
      key(['w'], 'w, s', 'from above, from below', orbit(0, 0.08, 1)),
      key(['s'], '', '', orbit(0, -0.08, 1)),
      key(['+', '='], '+, −', 'nearer, farther', orbit(0, 0, 0.88)),
      key(['-'], '', '', orbit(0, 0, 1 / 0.88)),
      key(['r'], 'r', 'the view of the start', () => this.stage.look('start')),
      key(['t'], 't', 'light or dark', () => this.theme.set(!this.theme.dark)),
      key(['?'], '?', 'this help', () => undefined),
    ];
  }

  // The forces on the body as the table has them, from the point about which torques are taken.
  private showForces(): void {
    const { balance, axes } = this.robot.inspection;
    const found = balance.find((b) => b.body === this.steps[this.at].body);
    if (!found || axes !== 'world') return this.stage.arrows.set([]);
    const most = Math.max(...found.wrenches.map(({ force }) => Math.hypot(...force)), 1e-300);
    const scale = (0.38 * this.robot.view.radius) / most;
    this.stage.arrows.set(
      found.wrenches.map(({ force }, i) => ({
        from: found.about as [number, number, number],
        along: force.map((part) => scale * part) as [number, number, number],
        color: token(`--c${i % 8}`),
      })),
    );
  }

  // The body of the step solid, the others as ghosts.
  private paint(): void {
    this.stale = false;
    const body = this.steps[this.at].body;
    const parts = this.robot.layers
      .filter((layer) => layer.name.startsWith('body/'))
      .map((layer) => {
        const alpha = layer.name === `body/${body}` ? undefined : FAINT;
        return { columns: layer.instances, a: 0, b: 0, share: 0, alpha, shadow: true };
      });
    const shown = this.layers.shown.filter((layer) => layer.name !== 'bodies');
    const overlays = shown.map((layer) => ({ columns: layer.instances, a: 0, b: 0, share: 0 }));
    this.stage.paint([...parts, ...overlays]);
    this.showForces();
    this.stage.draw();
    this.labels.paint(
      this.stage,
      this.robot.texts,
      shown.map((layer) => ({ columns: layer.labels, frame: 0 })),
    );
  }
}

// The colour of a wrench, in the table and in the picture.
function swatch(i: number): HTMLElement {
  const made = element('i', { class: 'swatch' });
  made.style.background = `var(--c${i % 8})`;
  return made;
}

type Told = Omit<InspectedRobot, 'inspection'> & { inspection: string };
start<Told>((told) => {
  const robot = { ...told, inspection: JSON.parse(told.inspection) as Inspection };
  return { robot, page: new Page(robot) };
});
