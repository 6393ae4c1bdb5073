// The page of one inspected state: the inspector over the numbers that the page carries, with the
// robot beside it.
import '../ui/style.css';
import { checkTable, checkWords } from '../inspector/checks';
import { Inspector, type InspectorPage } from '../inspector/inspector';
import type { BodyInspection } from '../protocol/messages';
import type { InspectedRobot, Inspection } from '../protocol/inspection';
import type { SceneMessage } from '../protocol/messages';
import { element } from '../ui/dom';
import { help, key, listen, MOUSE, pageHeader, viewKeys, type Key } from '../ui/keys';
import { Tabs } from '../ui/tabs';
import { Theme } from '../ui/theme';
import { Labels } from '../view/labels';
import { LayerChoice } from '../view/layers';
import { Stage } from '../view/stage';
import { Views } from '../view/views';
import './inspect.css';
import { onPaper } from './paper';
import './print.css';
import { start } from './start';

const FAINT = 60; // of 255: bodies that are not looked at

// Of one body, as the lab sends it.
function inspectionOf(all: Inspection, name: string): BodyInspection {
  const passes = all.passes.filter(({ body }) => body === name);
  return {
    ...all,
    kind: 'glass',
    scene: 0,
    stands: true,
    name,
    passes,
    rows: all.passes,
    balance: all.balance.filter(({ body }) => body === name),
    joint_balance: all.joint_balance.filter(({ joint }) => joint !== '' && joint === passes[0]?.joint),
    checks: undefined, // have a page of their own
    warnings: [],
  };
}

class Page {
  private stale = true;
  private readonly inspector: Inspector;
  private readonly host = element('div', { class: 'stage' });
  private readonly stage: Stage;
  private readonly labels: Labels;
  private readonly layers: LayerChoice;
  private readonly theme: Theme;

  constructor(private readonly robot: InspectedRobot) {
    this.theme = new Theme(() => {
      this.stage?.setTheme(this.theme.dark);
      this.inspector?.onTheme();
    });
    const overlays = robot.layers.filter((layer) => !layer.name.startsWith('body/'));
    this.layers = new LayerChoice(overlays, () => this.touch());
    const views = new Views((name) => this.stage.look(name), () => undefined);
    this.host.append(
      element('div', { class: 'labels', 'aria-hidden': 'true' }),
      this.layers.switches,
      this.layers.legend,
      views.root,
    );
    this.stage = new Stage(this.host, robot.view, robot, () => this.touch());
    this.labels = new Labels(this.host.querySelector('.labels')!);
    this.inspector = new Inspector(this.source());
    this.build();
    const asked = new URLSearchParams(location.hash.slice(1));
    const theme = asked.get('theme');
    if (theme) this.theme.set(theme === 'dark');
    this.stage.setTheme(this.theme.dark);
    this.inspector.go(Number(asked.get('step') ?? 1) - 1);
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
    return this.inspector.state;
  }

  // What the lab does for its inspector.
  private source(): InspectorPage {
    const { inspection, view } = this.robot;
    const names = inspection.passes.filter(({ pass }) => pass === 1).map(({ body }) => body);
    const bodies = ['world', ...names].map((name, i) => ({ name, moves: i > 0, robot: i > 0 }));
    const page: InspectorPage & { selected: number | null } = {
      scene: { scene: 0, bodies, view } as SceneMessage,
      selected: 1,
      send: (command) => {
        if (command.do === 'glass' && command.on)
          this.inspector.onGlass(inspectionOf(inspection, names[command.body! - 1]));
        return true;
      },
      select: (body) => {
        page.selected = body;
        this.inspector.onSelect(body);
        this.touch();
      },
      arrows: (_, arrows) => {
        this.stage.arrows.set(arrows);
        this.touch();
      },
    };
    return page;
  }

  private build(): void {
    const { robot } = this;
    const keys = this.keys();
    const dialog = help(keys, MOUSE);
    const tabs = new Tabs();
    const { checks, warnings } = robot.inspection;
    tabs.add('Passes', this.inspector.root);
    tabs.add(`Checks: ${checkWords(checks)}`, checkTable(checks, warnings));
    const title = [
      element('h1', {}, robot.title),
      element('p', {}, robot.state.replaceAll('\n', ' · ')),
    ];
    document.body.append(
      pageHeader(title, dialog, () => this.theme.toggle()),
      element('main', { class: 'inspect' }, this.host, tabs.root),
      element(
        'footer',
        { class: 'made-by' },
        element('code', { id: 'command' }, robot.command),
        element('span', {}, `twinarm ${robot.version}`),
      ),
      dialog,
    );
    listen(keys);
  }

  private keys(): Key[] {
    const pass = (number: number) => () => this.inspector.goPass(number);
    return [
      key(['ArrowRight', ' '], '→', 'the next body', () => this.inspector.move(1)),
      key(['ArrowLeft'], '←', 'the body before', () => this.inspector.move(-1)),
      key(['1'], '1, 2, 3', 'to that pass', pass(1)),
      key(['2'], '', '', pass(2)),
      key(['3'], '', '', pass(3)),
      ...viewKeys({
        orbit: (...by) => this.stage.orbit(...by),
        look: (name) => this.stage.look(name),
        toggleTheme: () => this.theme.toggle(),
      }),
    ];
  }

  private touch(): void {
    this.stale = true;
  }

  // The body of the step solid, the others as ghosts.
  private paint(): void {
    this.stale = false;
    const { body } = this.inspector.state;
    const parts = this.robot.layers
      .filter((layer) => layer.name.startsWith('body/'))
      .map((layer) => {
        const alpha = layer.name === `body/${body}` ? undefined : FAINT;
        return { columns: layer.instances, a: 0, b: 0, share: 0, alpha, shadow: true };
      });
    const shown = this.layers.shown.filter((layer) => layer.name !== 'bodies');
    const overlays = shown.map((layer) => ({ columns: layer.instances, a: 0, b: 0, share: 0 }));
    this.stage.paint([...parts, ...overlays]);
    this.stage.draw();
    const labels = shown.map((layer) => ({ columns: layer.labels, frame: 0 }));
    this.labels.paint(this.stage, this.robot.texts, labels);
  }
}

type Carried = Omit<InspectedRobot, 'inspection'> & { inspection: string };
start<Carried>((carried) => {
  const robot = { ...carried, inspection: JSON.parse(carried.inspection) as Inspection };
  return { robot, page: new Page(robot) };
});
