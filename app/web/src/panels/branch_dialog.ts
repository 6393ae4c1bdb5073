// Going on from an instant with other knobs: which ones is chosen here.
import './branch_dialog.css';
import { button, element, option, unitText } from '../ui/dom';
import type { Knob } from '../source/link';
import type { LabPage } from './panel';
import type { Rewind } from '../source/playhead';
import { numberText, parseNumber } from '../ui/scale';

type Line = { knob: Knob; root: HTMLElement; control: HTMLInputElement | HTMLSelectElement };

export class BranchDialog {
  readonly root = element('dialog.card-dialog.branch', { 'aria-labelledby': 'branch-title' });
  private readonly title = element('h2', { id: 'branch-title' });
  private readonly list = element('div.lines');
  private readonly none = element('p.hint', 'All knobs are left as they are now.');
  private readonly more = element('select', { 'aria-label': 'turn one more knob' });
  private lines: Line[] = [];
  private at = 0;

  constructor(
    private readonly page: LabPage,
    private readonly rewind: Rewind,
    private readonly changes: () => string[],
  ) {
    const words =
      'The run goes back to this instant and on from there; what the hand did is done again. ' +
      'The run that is left stays beside it: pale in the view, dotted in the plots.';
    const go = element('button.main', { type: 'submit' }, 'Branch');
    const form = element(
      'form',
      { method: 'dialog' },
      this.title,
      element('p', words),
      element('h3', 'Knobs that are turned'),
      this.list,
      this.none,
      this.more,
      element('div.ends', button('Cancel', 'nothing happens (Escape)', () => this.root.close()), go),
    );
    form.addEventListener('submit', (event) => {
      event.preventDefault();
      this.send();
    });
    this.more.addEventListener('change', () => this.add(this.more.value));
    this.root.addEventListener('keydown', (event) => event.stopPropagation());
    this.root.append(form);
  }

  ask(at: number): void {
    this.at = at;
    this.title.textContent = `Branch at ${at.toFixed(3)} s`;
    this.lines = [];
    this.list.replaceChildren();
    for (const change of this.changes()) this.add(change.slice(0, change.indexOf('=')));
    this.offer();
    this.root.showModal();
  }

  private offer(): void {
    const knobs = this.page.state?.knobs ?? [];
    const left = knobs.filter((knob) => !this.lines.some((line) => line.knob.path === knob.path));
    const offers = left.map(({ path, label, group }) => option(path, `${group}: ${label}`));
    this.more.replaceChildren(option('', 'turn one more knob …'), ...offers);
    this.none.hidden = this.lines.length > 0;
  }

  private add(path: string): void {
    const knob = this.page.state?.knobs.find((one) => one.path === path);
    if (!knob) return;
    const control = controlOf(knob);
    const { label, unit } = knob;
    const root = element('div.line', element('span', label), control, element('span.unit', unitText(unit)));
    const line = { knob, root, control };
    root.append(button('×', `leave ${label} as it is now`, () => this.remove(line)));
    this.lines.push(line);
    this.list.append(root);
    this.offer();
    control.focus();
  }

  private remove(line: Line): void {
    this.lines = this.lines.filter((other) => other !== line);
    line.root.remove();
    this.offer();
    this.more.focus();
  }

  private send(): void {
    const changes: string[] = [];
    for (const { knob, control } of this.lines) {
      const isNumber = knob.form !== 'choice';
      const number = isNumber ? parseNumber(control.value, knob.unit) : 0;
      control.setCustomValidity(Number.isNaN(number) ? 'a number' : '');
      if (!control.reportValidity()) return;
      changes.push(`${knob.path}=${isNumber ? number : control.value}`);
    }
    this.root.close();
    this.rewind.look(null);
    this.page.send({ do: 'branch', at: this.at, changes });
  }
}

function controlOf(knob: Knob): HTMLInputElement | HTMLSelectElement {
  const label = { 'aria-label': knob.label };
  const value = knob.value === null ? '' : numberText(Number(knob.value));
  if (knob.form !== 'choice') return element('input', { type: 'text', ...label, value });
  const control = element('select', label, ...(knob.choices ?? []).map((name) => option(name)));
  control.value = String(knob.value);
  return control;
}
