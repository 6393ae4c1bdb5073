// Menu that adds a floor, objects and springs to the scene, or removes a body. The run restarts.
import { button, changeDetector, element } from '../ui/dom';
import { isViewOnly, type SceneBody, type StateMessage } from '../source/link';
import type { LabPage, Panel } from './panel';
import { closeOutside } from './menus';

const OBJECTS: [string, string, string][] = [
  ['floor', 'Floor', 'below everything, fixed'],
  ['box', 'Box', 'dropped from above'],
  ['sphere', 'Ball', 'dropped from above'],
];
const MAX_LINKS = 16;

export class BuildMenu implements Panel {
  readonly root = element('details.menu.build');
  private readonly sheet = element('div.sheet');
  private readonly isNew = changeDetector();

  constructor(private readonly page: LabPage) {
    this.root.append(element('summary', { title: 'add a floor, objects or springs' }, 'Add'), this.sheet);
    closeOutside(this.root);
  }

  onState(state: StateMessage): void {
    const { scene, selected } = this.page;
    const bodies = scene?.bodies ?? [];
    const chosen = selected === null ? undefined : bodies[selected];
    const isDisabled = isViewOnly(state);
    if (!this.isNew(scene?.scene, chosen?.name, isDisabled)) return;
    const rows = OBJECTS.map(([what, name, words]) => this.offer(name, words, what));
    rows.push(...this.springs(bodies, chosen));
    if (chosen && !chosen.robot)
      rows.push(this.offer(`Remove ${chosen.name}`, 'the selected body', 'remove', chosen.name));
    this.sheet.replaceChildren(...rows);
    for (const control of this.sheet.querySelectorAll('button')) control.disabled = isDisabled;
  }

  onSelect(): void {
    if (this.page.state) this.onState(this.page.state);
  }

  // To the kinematic robot, which the pointer then drags.
  private springs(bodies: SceneBody[], chosen?: SceneBody): HTMLElement[] {
    const links = bodies.filter(({ moves, robot }) => moves && robot);
    if (links.length === 0) return [];
    const shown = links.length > MAX_LINKS ? links.filter((link) => link === chosen) : links;
    const at = shown.map(({ name }) => button(name, `spring-damper at ${name}`, () => this.send('link-spring', name)));
    const select = element('span.fine', 'select a link first');
    return [
      this.offer('Springs at all joints', 'to a kinematic robot that you drag', 'joint-springs'),
      element('div.links', element('b', 'Spring at'), ...(at.length > 0 ? at : [select])),
    ];
  }

  private offer(label: string, words: string, what: string, name?: string): HTMLElement {
    return button([element('b', label), element('span.fine', words)], words, () => this.send(what, name));
  }

  private send(what: string, name?: string): void {
    this.page.send({ do: 'edit', what, name: name ?? '' });
    this.root.open = false;
  }
}
