// The page of one inspected state: the passes of the articulated-body algorithm, body by body, with
// the robot beside them.
import './style.css';
import './inspect.css';
import type { InspectedRobot, Inspection, PassStep } from './data/inspection';
import { balanceTable, wrenchColor } from './ui/balance';
import { checkTable, checkWords } from './ui/checks';
import { button, element, icon } from './ui/dom';
import { help, listen, type Key } from './ui/keys';
import { LayerChoice } from './ui/layers';
import { onPaper } from './ui/paper';
import { quantityCard } from './ui/quantity';
import { start } from './ui/start';
import { PASSES, Stepper } from './ui/stepper';
import { Tabs } from './ui/tabs';
import { Theme } from './ui/theme';
import { Labels } from './view/labels';
import { Stage, type ViewName } from './view/stage';

const FAINT = 60; // of 255: bodies that are not looked at

class Page {
  private at = 0;
  private stale = true;
  private readonly steps: PassStep[];
  private readonly stepper: Stepper;
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
    const goPass = (pass: number) => this.go(this.steps.findIndex((step) => step.pass === pass));
    this.stepper = new Stepper((step) => this.go(step), goPass);
    this.stepper.set(this.steps);
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
    tabs.add('Passes', this.stepper.root, this.heading, this.cards, this.balance);
    const { checks, warnings } = robot.inspection;
    tabs.add(`Checks: ${checkWords(checks)}`, checkTable(checks, warnings));
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

  private go(step: number): void {
    this.at = Math.min(this.steps.length - 1, Math.max(0, step || 0));
    const { pass, body, joint, quantities } = this.steps[this.at];
    this.stepper.show(this.at);
    this.heading.replaceChildren(
      element('h2', {}, body),
      element('p', {}, `${PASSES[pass].join(': ')}. Carried by ${joint || 'the base'}.`),
    );
    // Matrices at the left, what is smaller beside them.
    const cards = quantities.map((quantity) => quantityCard(quantity));
    const column = (matrices: boolean) =>
      element('div', {}, ...cards.filter((card) => !!card.querySelector('.heat') === matrices));
    const columns = [column(true), column(false)].filter((c) => c.children.length > 0);
    this.cards.classList.toggle('two', columns.length === 2);
    this.cards.replaceChildren(...columns);
    const { balance, axes, about } = this.robot.inspection;
    const found = balance.find((b) => b.body === body);
    this.balance.replaceChildren(...(found ? [balanceTable(found, axes, about)] : []));
    this.stale = true;
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
        color: wrenchColor(i),
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

type Told = Omit<InspectedRobot, 'inspection'> & { inspection: string };
start<Told>((told) => {
  const robot = { ...told, inspection: JSON.parse(told.inspection) as Inspection };
  return { robot, page: new Page(robot) };
});
