// What can be turned while the run goes on: presets, then knobs by their groups. Many changes of
// one moment (a slider that moves) are sent as one, ten times a second.
import { button, element } from '../ui/dom';
import { knobRow, shapeOf, type KnobRow } from './knob_row';
import type { Knob, StateMessage } from './link';
import type { LabPage, Panel } from './panel';

const PAUSE = 100; // between two messages [ms]

export class Knobs implements Panel {
  readonly root = element('div', { class: 'knobs' });
  private readonly presets = element('div', { class: 'presets' });
  private readonly watching = element('p', { class: 'note' });
  private readonly groups = element('div');
  private readonly again: HTMLButtonElement;
  private readonly rows = new Map<string, KnobRow>();
  private readonly waiting = new Map<string, string>(); // changes not sent yet
  private timer = 0;
  private sentAt = -Infinity;
  private shape = '';
  private shownPresets = '';
  private scene = -1;
  private readonly first = new Map<string, string>(); // values that the scene came with
  private values = new Map<string, string>();

  constructor(private readonly page: LabPage) {
    this.again = button('Reset knobs', 'all knobs as the scene has them', () => this.reset());
    this.root.append(this.watching, this.presets, this.groups, this.again);
  }

  // What differs from the scene: what a branch may be asked with.
  get changes(): string[] {
    return [...this.values]
      .filter(([path, value]) => this.first.has(path) && this.first.get(path) !== value)
      .map(([path, value]) => `${path}=${value}`);
  }

  onState(state: StateMessage): void {
    const { knobs, presets, holder, you } = state;
    const scene = this.page.scene?.scene ?? 0;
    if (scene !== this.scene) {
      this.scene = scene;
      this.first.clear();
    }
    const told = knobs.filter(({ value }) => value !== null);
    this.values = new Map(told.map(({ path, value }) => [path, String(value)]));
    for (const [path, value] of this.values)
      if (!this.first.has(path)) this.first.set(path, value);
    const shape = knobs.map(shapeOf).join();
    if (shape !== this.shape) {
      this.shape = shape;
      this.build(knobs);
    } else for (const knob of knobs) this.rows.get(knob.path)!.update(knob);
    this.showPresets(presets);
    const watches = holder !== null && holder !== you;
    this.watching.hidden = !watches;
    this.watching.textContent = watches
      ? 'Somebody else holds the hand: you see what they turn. Ask for the hand to turn yourself.'
      : '';
    for (const row of this.rows.values()) row.enable(!watches);
    for (const preset of this.presets.querySelectorAll('button')) preset.disabled = watches;
    this.again.disabled = watches || this.changes.length === 0;
  }

  private build(knobs: Knob[]): void {
    this.rows.clear();
    const groups = new Map<string, HTMLElement>();
    for (const knob of knobs) {
      const row = knobRow(knob, (path, value) => this.turn(path, value));
      this.rows.set(knob.path, row);
      let group = groups.get(knob.group);
      if (!group) {
        group = element('fieldset', { class: 'group' }, element('legend', {}, knob.group));
        groups.set(knob.group, group);
      }
      group.append(row.root);
    }
    this.groups.replaceChildren(...groups.values());
  }

  private showPresets(presets: StateMessage['presets']): void {
    const wanted = JSON.stringify(presets);
    if (wanted === this.shownPresets) return;
    this.shownPresets = wanted;
    const buttons = presets.map(({ name, what }) => {
      const made = element(
        'button',
        { type: 'button', title: what },
        element('b', {}, name),
        element('span', {}, what),
      );
      made.addEventListener('click', () => this.page.send({ do: 'preset', name }));
      return made;
    });
    this.presets.replaceChildren(...buttons);
    this.presets.hidden = presets.length === 0;
  }

  private turn(path: string, value: string): void {
    this.waiting.set(path, value);
    const left = this.sentAt + PAUSE - performance.now();
    if (this.timer) return;
    if (left <= 0) this.flush();
    else this.timer = setTimeout(() => this.flush(), left);
  }

  private flush(): void {
    clearTimeout(this.timer);
    this.timer = 0;
    this.sentAt = performance.now();
    const changes = [...this.waiting].map(([path, value]) => `${path}=${value}`);
    this.waiting.clear();
    this.page.send({ do: 'set', changes });
  }

  private reset(): void {
    for (const [path, value] of this.first)
      if (this.values.get(path) !== value) this.waiting.set(path, value);
    if (this.waiting.size > 0) this.flush();
  }
}
