// The inspector without the lab: messages come from the test, commands are recorded.
import '../../app/web/src/ui/style.css';
import { Inspector } from '../../app/web/src/inspector/inspector';
import type { BodyInspection } from '../../app/web/src/protocol/messages';
import type { Command, SceneMessage } from '../../app/web/src/source/link';
import type { LabPage } from '../../app/web/src/panels/panel';

const sent: Command[] = [];
let arrows: unknown[] = [];
const bodies = (document.documentElement.dataset.bodies ?? 'world,base').split(',');
const page = {
  scene: {
    kind: 'scene',
    scene: 1,
    bodies: bodies.map((name, i) => ({ name, moves: i > 1, robot: i > 0 })),
    joints: [],
    view: { radius: 1 },
  } as unknown as SceneMessage,
  selected: null as number | null,
  send(command: Command) {
    sent.push(command);
    return true;
  },
  select(body: number | null) {
    page.selected = body;
    panel.onSelect?.(body);
  },
  arrows(given: unknown[]) {
    arrows = given;
  },
};
const panel = new Inspector(page as unknown as LabPage);
document.body.className = 'harness';
document.body.append(panel.root);
Object.assign(window, {
  inspector: {
    panel,
    sent,
    get arrows() {
      return arrows;
    },
    give: (message: unknown) => panel.onInspection?.(message as BodyInspection),
    theme: (dark: boolean) => (document.documentElement.dataset.theme = dark ? 'dark' : 'light'),
  },
});
document.documentElement.dataset.ready = 'true';
