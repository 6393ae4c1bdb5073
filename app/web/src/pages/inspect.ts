// Page of one inspected state: 3-D view and inspector.
import { checkTable, checkSummary } from '../inspector/tables';
import { Inspector, type InspectorPage } from '../inspector/inspector';
import type { InspectedRobot, Inspection } from '../protocol/inspection';
import type { BodyInspection, SceneMessage } from '../protocol/messages';
import type { Layer } from '../protocol/run';
import { element } from '../ui/dom';
import { key, type Key, MOUSE } from '../ui/keys';
import './inspect.css';
import { type Instant, RecordedPage } from './recorded_page';
import { start } from '../source/embedded';

const FAINT = 60; // alpha of 255 of the other bodies

// Of one body, as the lab's message.
function inspectionOf(all: Inspection, name: string): BodyInspection {
  const passes = all.passes.filter(({ body }) => body === name);
  return {
    ...all,
    kind: 'inspection',
    scene: 0,
    paused: true,
    name,
    passes,
    rows: all.passes,
    balance: all.balance.filter(({ body }) => body === name),
    joint_balance: all.joint_balance.filter(({ joint }) => joint !== '' && joint === passes[0]?.joint),
    checks: undefined, // in their own tab
    warnings: [],
  };
}

class Page extends RecordedPage {
  private readonly inspector: Inspector;
  private readonly bodies: Layer[];

  constructor(private readonly robot: InspectedRobot) {
    const isBody = ({ name }: Layer) => name.startsWith('body/');
    super(robot, robot.layers.filter((layer) => !isBody(layer)), false); // 1 to 3: passes
    this.bodies = robot.layers.filter(isBody);
    this.inspector = new Inspector(this.source());
    const { checks, warnings } = robot.inspection;
    this.tabs.add('Passes', this.inspector.root);
    this.tabs.add(`Cross-checks: ${checkSummary(checks)}`, checkTable(checks, warnings));
    this.tabs.root.parentElement!.classList.add('inspect');
    const title = [element('h1', robot.title), element('p', robot.state.replaceAll('\n', ' · '))];
    const foot = element(
      'footer.made-by',
      element('code', { id: 'command' }, robot.command),
      element('span', `twinarm ${robot.version}`),
    );
    this.begin(title, foot, this.keys(), MOUSE);
    this.inspector.go(Number(this.hashValue('step') ?? 1) - 1);
  }

  get state() {
    return this.inspector.state;
  }

  // The lab's interface to its inspector.
  private source(): InspectorPage {
    const { inspection, view } = this.robot;
    const names = inspection.passes.filter(({ pass }) => pass === 1).map(({ body }) => body);
    const bodies = ['world', ...names].map((name, i) => ({ name, moves: i > 0, robot: i > 0 }));
    const page: InspectorPage & { selected: number | null } = {
      scene: { scene: 0, bodies, view } as SceneMessage,
      selected: 1,
      send: (command) => {
        if (command.do === 'inspect' && command.on)
          this.inspector.onInspection(inspectionOf(inspection, names[command.body! - 1]));
        return true;
      },
      select: (body) => {
        page.selected = body;
        this.inspector.onSelect(body);
        this.touch();
      },
      arrows: (arrows) => {
        this.stage.arrows.set(arrows);
        this.touch();
      },
    };
    return page;
  }

  private keys(): Key[] {
    const next = () => this.inspector.move(1);
    const pass = (number: number) => () => this.inspector.goPass(number);
    return [
      key('→', 'next body', { ArrowRight: next, ' ': next }),
      key('←', 'previous body', { ArrowLeft: () => this.inspector.move(-1) }),
      key('1, 2, 3', 'pass', { 1: pass(1), 2: pass(2), 3: pass(3) }),
      ...this.viewKeys(),
    ];
  }

  protected recolor(): void {
    super.recolor();
    this.inspector.onTheme();
  }

  protected before(): Instant {
    return { a: 0, b: 0, share: 0 };
  }

  // The body of the step solid, the others translucent.
  protected parts(shown: Layer[], instant: Instant) {
    const { body } = this.inspector.state;
    const bodies = this.bodies.map(({ name, instances }) => {
      const alpha = name === `body/${body}` ? undefined : FAINT;
      return { ...instant, columns: instances, alpha, shadow: true };
    });
    const overlays = shown.filter(({ name }) => name !== 'bodies');
    return [...bodies, ...super.parts(overlays, instant)];
  }
}

type Packed = Omit<InspectedRobot, 'inspection'> & { inspection: string };
start<Packed>((packed) => {
  const robot = { ...packed, inspection: JSON.parse(packed.inspection) as Inspection };
  return { robot, page: new Page(robot) };
});
