// Panel of presets and parameters by group. Changes are collected and sent ten times a second.
import './parameters.css';
import { button, changeDetector, element } from '../ui/dom';
import { parameterRow, type ParameterRow, shapeOf } from './parameter_row';
import { isChanged, type LabParameter, type StateMessage, isViewOnly } from '../source/link';
import type { LabPage, Panel } from './panel';

const PAUSE = 100; // between two messages [ms]
const VIEW_ONLY = 'View only: another client has control. Request control to change parameters.';

const RESTORE = 'restore all parameters of the scene file (the run continues)';

export class Parameters implements Panel {
  readonly root = element('div.parameters');
  private readonly presets = element('div.presets');
  private readonly viewOnly = element('p.note', VIEW_ONLY);
  private readonly groups = element('div');
  private readonly restore = button('Reset', RESTORE, () => {
    this.takeWaiting();
    this.page.send({ do: 'reset_parameters' });
  });
  private readonly rows = new Map<string, ParameterRow>();
  private readonly waiting = new Map<string, string>(); // changes not sent yet
  private readonly folded = new Map<string, boolean>(); // groups that were opened or closed here
  private timer = 0;
  private sentAt = -Infinity;
  private readonly areParametersNew = changeDetector();
  private readonly arePresetsNew = changeDetector();

  constructor(private readonly page: LabPage) {
    this.root.append(this.viewOnly, this.presets, this.groups, this.restore);
  }

  // Relative to the scene file.
  get changes(): string[] {
    const changed = this.page.state?.parameters.filter(isChanged) ?? [];
    return changed.filter(({ value }) => value !== null).map(({ path, value }) => `${path}=${value}`);
  }

  onState(state: StateMessage): void {
    const { parameters, presets, gallery, name } = state;
    if (this.areParametersNew(parameters.map(shapeOf))) this.build(parameters);
    else for (const parameter of parameters) this.rows.get(parameter.path)!.update(parameter);
    this.showPresets(presets);
    const isOurs = [...gallery, ...presets].some((scene) => scene.name === name);
    this.presets.hidden = !isOurs || state.input.source === ''; // for scenes with a target robot
    const isDisabled = isViewOnly(state);
    this.viewOnly.hidden = !isDisabled;
    for (const control of this.root.querySelectorAll('input, select, button'))
      control.toggleAttribute('disabled', isDisabled);
    this.restore.disabled = isDisabled || !state.changes?.length;
  }

  // Keeps the focus, and the text that is being typed.
  private build(parameters: LabParameter[]): void {
    const before = document.activeElement;
    const at = before?.closest<HTMLElement>('.parameter')?.dataset.path;
    const isTyped = before instanceof HTMLInputElement && before.type === 'text' &&
      before.selectionEnd === before.selectionStart;
    const typed = isTyped ? before.value : null; // else all is selected
    this.rows.clear();
    const groups = new Map<string, HTMLElement>();
    for (const parameter of parameters) {
      const { path, group } = parameter;
      const row = parameterRow(parameter, (path, value) => this.set(path, value));
      this.rows.set(path, row);
      if (!groups.has(group)) groups.set(group, this.group(group, parameter.folded));
      groups.get(group)!.append(row.root);
    }
    this.groups.replaceChildren(...groups.values());
    if (at !== undefined) this.rows.get(at)?.focus(before!, typed);
  }

  // Stays folded when the rows are replaced.
  private group(name: string, isFolded: boolean): HTMLElement {
    const made = element('details.group', element('summary', name));
    made.open = !(this.folded.get(name) ?? isFolded);
    made.addEventListener('toggle', () => {
      if (made.open === (this.folded.get(name) ?? isFolded)) this.folded.set(name, !made.open);
    });
    return made;
  }

  private showPresets(presets: StateMessage['presets']): void {
    if (!this.arePresetsNew(presets)) return;
    const buttons = presets.map(({ name, what }) => {
      const label = [element('b', name), element('span.fine', what)];
      return button(label, what, () => this.page.send({ do: 'preset', name }));
    });
    this.presets.replaceChildren(...buttons);
  }

  private set(path: string, value: string): void {
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

  private takeWaiting(): string[] {
    clearTimeout(this.timer);
    this.timer = 0;
    const changes = [...this.waiting].map(([path, value]) => `${path}=${value}`);
    this.waiting.clear();
    return changes;
  }
}
