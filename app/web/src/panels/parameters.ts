// What can be turned while the run goes on: presets, then knobs by their groups. Many changes of
// one moment (a slider that moves) are sent as one, ten times a second.
import './parameters.css';
import { button, changeDetector, element } from '../ui/dom';
import { parameterRow, type ParameterRow, shapeOf } from './parameter_row';
import { isTurned, type Knob, type StateMessage, watches } from '../source/link';
import type { LabPage, Panel } from './panel';

const PAUSE = 100; // between two messages [ms]
const WATCHING =
  'Somebody else holds the hand: you see what they turn. Ask for the hand to turn yourself.';

export class Parameters implements Panel {
  readonly root = element('div.knobs');
  private readonly presets = element('div.presets');
  private readonly watching = element('p.note', WATCHING);
  private readonly groups = element('div');
  private readonly again = button('Reset knobs', 'all knobs as the scene came; the run goes on', () =>
    this.reset(),
  );
  private readonly rows = new Map<string, ParameterRow>();
  private readonly waiting = new Map<string, string>(); // changes not sent yet
  private readonly folded = new Set<string>(); // groups
  private timer = 0;
  private sentAt = -Infinity;
  private readonly areKnobsNew = changeDetector();
  private readonly arePresetsNew = changeDetector();

  constructor(private readonly page: LabPage) {
    this.root.append(this.watching, this.presets, this.groups, this.again);
  }

  // What differs from the scene's file.
  get changes(): string[] {
    const turned = this.page.state?.knobs.filter(isTurned) ?? [];
    return turned.filter(({ value }) => value !== null).map(({ path, value }) => `${path}=${value}`);
  }

  onState(state: StateMessage): void {
    const { knobs, presets } = state;
    if (this.areKnobsNew(knobs.map(shapeOf))) this.build(knobs);
    else for (const knob of knobs) this.rows.get(knob.path)!.update(knob);
    this.showPresets(presets);
    const isWatching = watches(state);
    this.watching.hidden = !isWatching;
    for (const row of this.rows.values()) row.enable(!isWatching);
    for (const preset of this.presets.querySelectorAll('button')) preset.disabled = isWatching;
    this.again.disabled = isWatching || !state.changes?.length;
  }

  // Who was at a knob is there again.
  private build(knobs: Knob[]): void {
    const at = document.activeElement?.closest<HTMLElement>('.knob')?.dataset.path;
    this.rows.clear();
    const groups = new Map<string, HTMLElement>();
    for (const knob of knobs) {
      const row = parameterRow(knob, (path, value) => this.turn(path, value));
      this.rows.set(knob.path, row);
      if (!groups.has(knob.group)) groups.set(knob.group, this.group(knob.group));
      groups.get(knob.group)!.append(row.root);
    }
    this.groups.replaceChildren(...groups.values());
    if (at !== undefined) this.rows.get(at)?.focus();
  }

  // Stays folded when the knobs are built anew.
  private group(name: string): HTMLElement {
    const made = element('details.group', element('summary', name));
    made.open = !this.folded.has(name);
    made.addEventListener('toggle', () => {
      if (made.open) this.folded.delete(name);
      else this.folded.add(name);
    });
    return made;
  }

  private showPresets(presets: StateMessage['presets']): void {
    if (!this.arePresetsNew(presets)) return;
    const buttons = presets.map(({ name, what }) => {
      const words = [element('b', name), element('span', what)];
      return button(words, what, () => this.page.send({ do: 'preset', name }));
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
    this.sentAt = performance.now();
    this.page.send({ do: 'set', changes: this.takeWaiting() });
  }

  private reset(): void {
    this.takeWaiting();
    this.page.send({ do: 'restore' });
  }

  private takeWaiting(): string[] {
    clearTimeout(this.timer);
    this.timer = 0;
    const changes = [...this.waiting].map(([path, value]) => `${path}=${value}`);
    this.waiting.clear();
    return changes;
  }
}
