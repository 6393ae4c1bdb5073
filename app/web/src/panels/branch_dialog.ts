// Dialog of a new branch: its parameter changes.
import './branch_dialog.css';
import { button, element, option, unitText } from '../ui/dom';
import type { LabParameter } from '../source/link';
import type { LabPage } from './panel';
import type { Rewind } from '../source/playhead';
import { numberText, parseNumber } from '../ui/scale';

type Line = { parameter: LabParameter; root: HTMLElement; control: HTMLInputElement | HTMLSelectElement };

export class BranchDialog {
  readonly root = element('dialog.card-dialog.branch', { 'aria-labelledby': 'branch-title' });
  private readonly title = element('h2', { id: 'branch-title' });
  private readonly list = element('div.lines');
  private readonly none = element('p.hint', 'No parameter is changed.');
  private readonly more = element('select', { 'aria-label': 'add a parameter' });
  private lines: Line[] = [];
  private at = 0;

  constructor(
    private readonly page: LabPage,
    private readonly rewind: Rewind,
    private readonly changes: () => string[],
  ) {
    const text = 'The run continues from this instant; recorded input is repeated. The previous branch remains ' +
      'visible: translucent in the view, dotted in the plots.';
    const form = element(
      'form',
      { method: 'dialog', submit: (event: Event) => this.send(event) },
      this.title,
      element('p.fine', text),
      element('h3', 'Changed parameters'),
      this.list,
      this.none,
      this.more,
      element(
        'div.ends',
        button('Cancel', 'close (Escape)', () => this.root.close()),
        element('button.main', { type: 'submit' }, 'Branch'),
      ),
    );
    this.more.addEventListener('change', () => this.add(this.more.value));
    this.root.addEventListener('keydown', (event) => event.stopPropagation());
    this.root.append(form);
  }

  open(at: number): void {
    this.at = at;
    this.title.textContent = `Branch at ${at.toFixed(3)} s`;
    this.lines = [];
    this.list.replaceChildren();
    for (const change of this.changes()) this.add(change.slice(0, change.indexOf('=')));
    this.offer();
    this.root.showModal();
  }

  private offer(): void {
    const all = this.page.state?.parameters ?? [];
    const left = all.filter(({ path }) => !this.lines.some((line) => line.parameter.path === path));
    const offers = left.map(({ path, label, group }) => option(path, `${group}: ${label}`));
    this.more.replaceChildren(option('', 'add a parameter …'), ...offers);
    this.none.hidden = this.lines.length > 0;
  }

  private add(path: string): void {
    const parameter = this.page.state?.parameters.find((one) => one.path === path);
    if (!parameter) return;
    const control = controlOf(parameter);
    const { label, unit } = parameter;
    const root = element('div.line', element('span', label), control, element('span.unit', unitText(unit)));
    const line = { parameter, root, control };
    root.append(button('×', `do not change ${label}`, () => this.remove(line)));
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

  private send(event: Event): void {
    event.preventDefault();
    const changes: string[] = [];
    for (const { parameter: { form, unit, path }, control } of this.lines) {
      const value = form === 'choice' ? control.value : parseNumber(control.value, unit);
      control.setCustomValidity(Number.isNaN(value) ? 'a number' : '');
      if (!control.reportValidity()) return;
      changes.push(`${path}=${value}`);
    }
    this.root.close();
    this.rewind.branch(this.at, changes);
  }
}

function controlOf({ label, value, form, choices }: LabParameter): HTMLInputElement | HTMLSelectElement {
  const name = { 'aria-label': label };
  const text = value === null ? '' : numberText(Number(value));
  if (form !== 'choice') return element('input', { type: 'text', ...name, value: text });
  const control = element('select', name, ...(choices ?? []).map((choice) => option(choice)));
  control.value = String(value);
  return control;
}
