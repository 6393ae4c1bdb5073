// One parameter: name, control, and predictions for its value.
import { changeDetector, element, icon, option, statusLine, unitText } from '../ui/dom';
import { isChanged, type LabParameter } from '../source/link';
import { numberText, parseNumber, placeOf, type Scale, stepped, valueAt } from '../ui/scale';
import { putMark, Slider } from '../ui/slider';
import { Segments } from '../ui/choices';

const SETTLE = 800; // until the lab's state has the value that was set [ms]
const MAX_SEGMENTS = 3; // choices side by side, if they fit into WIDTH [pixels]
const WIDTH = 250;
const LETTER = 7.4;
const GAP = 20;
const RESTARTS = 'resets the solver memory (warm starts, past poses); positions and velocities are kept';

type SetValue = (path: string, value: string) => void;

export abstract class ParameterRow {
  readonly root = element('div.parameter');
  protected readonly side = element('div.predicted.fine', { 'aria-live': 'polite' });
  private readonly isNew = changeDetector();
  private setAt = -Infinity;

  constructor(protected parameter: LabParameter, private readonly setValue: SetValue) {
    this.root.dataset.path = parameter.path;
  }

  // Shows the lab's value, unless it is being edited here.
  update(parameter: LabParameter): void {
    this.parameter = parameter;
    if (!this.isHeld() && performance.now() - this.setAt > SETTLE) this.show(parameter.value);
    else if (String(parameter.value) === this.sent) this.setAt = -Infinity;
    this.showStatus(parameter);
  }

  // The control that has replaced `before`, whose text was `typed`.
  focus(before: Element, typed: string | null): void {
    const controls = [...this.root.querySelectorAll<HTMLElement>('input, select, [tabindex="0"]')];
    const now = controls.find(({ ariaLabel }) => ariaLabel === before.ariaLabel) ?? controls[0];
    now?.focus();
    if (typed !== null && now instanceof HTMLInputElement) now.value = typed;
  }

  // With the group: several couplings have a stiffness.
  protected get fullName(): string {
    return `${this.parameter.group}: ${this.parameter.label}`;
  }

  protected sent = '';
  protected set(value: string): void {
    this.sent = value;
    this.setAt = performance.now();
    this.setValue(this.parameter.path, value);
  }

  protected abstract show(value: LabParameter['value']): void;
  protected abstract isHeld(): boolean;
  protected limited(_limit: number | null): void {}

  protected head(control: HTMLElement[], id?: string): void {
    const { label, meaning, restarts } = this.parameter;
    const name = element(id ? 'label' : 'span', { class: 'name', title: meaning }, label);
    if (id) name.setAttribute('for', id);
    if (restarts) {
      const attributes = { role: 'img', title: RESTARTS, 'aria-label': RESTARTS };
      name.append(element('span.restarts', attributes, icon('again')));
    }
    this.root.append(name, ...control, this.side);
  }

  private showStatus(parameter: LabParameter): void {
    const { limit, tracking_error, start, unit } = parameter;
    const hasChanged = isChanged(parameter);
    if (!this.isNew(limit, tracking_error, hasChanged)) return;
    const lines: HTMLElement[] = [];
    if (limit) lines.push(statusLine(limit.state, limit.words));
    if (tracking_error) lines.push(element('span', `tracking error ${tracking_error}`));
    const from = start ? `${start} ${unitText(unit)}` : 'not set';
    if (hasChanged) lines.push(element('span', `scene file: ${from.trim()}`));
    this.root.classList.toggle('changed', hasChanged);
    this.side.replaceChildren(...lines);
    this.root.dataset.limit = limit?.state ?? '';
    this.limited(limit?.value ?? null);
  }
}

// A slider, if there is a range, and a number field.
class NumberRow extends ParameterRow {
  private readonly scale: Scale | null;
  private readonly slider: Slider | null;
  private readonly mark = element('i.mark', { 'aria-hidden': 'true' });
  private readonly field: HTMLInputElement;
  private value = NaN;

  constructor(parameter: LabParameter, setValue: SetValue) {
    super(parameter, setValue);
    const { form, low, high, path, unit } = parameter;
    const hasRange = low !== undefined && high !== undefined && high > low;
    this.scale = hasRange && (form === 'log' || form === 'linear') ? { form, low, high } : null;
    const id = `parameter-${path.replaceAll(/[^\w]/g, '-')}`;
    this.field = element('input', {
      type: 'text',
      id,
      inputmode: 'decimal',
      autocomplete: 'off',
      spellcheck: 'false',
      placeholder: '–',
      'aria-label': `${this.fullName}${unit && unit !== '1' ? ` in ${unit}` : ''}`,
      title: `${parameter.meaning.replace(/\.$/, '')}. Enter: set, Escape: cancel, arrow keys: change`,
      focus: () => this.select(),
      input: () => this.field.setCustomValidity(''),
      blur: () => this.show(this.parameter.value),
    });
    const { scale } = this;
    const slide = (place: number) => this.put(valueAt(scale!, place));
    this.slider = scale && new Slider(this.fullName, slide, this.mark);
    const number = element('div.number', this.field, element('span.unit', unitText(unit)));
    this.head(this.slider ? [this.slider.root, number] : [number], id);
    for (const at of [this.slider?.input, this.field])
      at?.addEventListener('keydown', (event) => this.press(event));
    this.update(parameter);
  }

  protected isHeld(): boolean {
    return this.slider?.isHeld || document.activeElement === this.field;
  }

  protected show(value: LabParameter['value']): void {
    this.value = value === null ? NaN : Number(value);
    this.field.value = value === null ? '' : numberText(this.value);
    this.field.setCustomValidity('');
    if (!this.scale || !this.slider) return;
    const place = placeOf(this.scale, this.value);
    this.slider.put(place);
    this.slider.fill(place, `${this.field.value} ${this.parameter.unit}`);
  }

  protected limited(limit: number | null): void {
    const { scale } = this;
    const isShown = scale && limit !== null && limit >= scale.low && limit <= scale.high;
    putMark(this.mark, isShown ? placeOf(scale, limit) : null);
    this.mark.title = limit === null ? '' : `limit ${numberText(limit)} ${this.parameter.unit}`;
  }

  private put(value: number): void {
    this.show(value);
    this.set(String(value));
  }

  private select(): void {
    if (!Number.isNaN(this.value)) this.field.value = String(this.value); // all digits
    this.field.select();
  }

  private press(event: KeyboardEvent): void {
    const isField = event.target === this.field;
    const way = { ArrowUp: 1, ArrowRight: 1, PageUp: 1, ArrowDown: -1, ArrowLeft: -1, PageDown: -1 };
    const sideways = event.key === 'ArrowLeft' || event.key === 'ArrowRight';
    if (isField && event.key === 'Enter') this.commit();
    else if (isField && event.key === 'Escape') {
      this.show(this.parameter.value);
      this.field.select();
    } else if (event.key in way && !(isField && sideways)) {
      const scale = this.scale ?? this.near();
      const coarse = event.shiftKey || event.key.startsWith('Page');
      this.put(stepped(scale, this.value, way[event.key as keyof typeof way] as 1 | -1, coarse));
    } else if (!isField && (event.key === 'Home' || event.key === 'End') && this.scale) {
      this.put(event.key === 'Home' ? this.scale.low : this.scale.high);
    } else return;
    event.preventDefault();
    event.stopPropagation();
  }

  // Of a number without a range: proportional to the number.
  private near(): Scale {
    const size = Math.abs(this.value) || 1;
    return { form: 'linear', low: -5 * size, high: 5 * size };
  }

  private commit(): void {
    const { unit } = this.parameter;
    const value = parseNumber(this.field.value, unit);
    const expected = unit && unit !== '1' ? `a number in ${unitText(unit)}` : 'a number';
    this.field.setCustomValidity(Number.isNaN(value) ? expected : '');
    if (!this.field.reportValidity()) return;
    this.put(value);
    this.field.select();
  }
}

// Segmented buttons, or a list of many choices.
class ChoiceRow extends ParameterRow {
  private readonly control: Segments | HTMLSelectElement;
  private readonly left = element('option', { value: '', disabled: '' }, 'not set');

  constructor(parameter: LabParameter, setValue: SetValue) {
    super(parameter, setValue);
    const choices = parameter.choices ?? [];
    const letters = choices.join('').length;
    if (choices.length <= MAX_SEGMENTS && LETTER * letters + GAP * choices.length < WIDTH) {
      this.control = new Segments(this.fullName, choices, '', (name) => this.set(name));
      this.head([this.control.root]);
    } else {
      const change = () => this.set((this.control as HTMLSelectElement).value);
      const attributes = { 'aria-label': this.fullName, title: parameter.meaning, change };
      this.control = element('select', attributes, this.left, ...choices.map((name) => option(name)));
      this.head([this.control]);
    }
    this.root.classList.add('choice');
    this.update(parameter);
  }

  protected isHeld(): boolean {
    return false;
  }
  protected show(value: LabParameter['value']): void {
    if (this.control instanceof Segments) this.control.show(String(value));
    else {
      const name = String(value ?? '');
      const isOffered = this.parameter.choices?.includes(name) ?? false;
      this.left.hidden = isOffered;
      this.control.value = isOffered ? name : '';
    }
  }
}

export function parameterRow(parameter: LabParameter, setValue: SetValue): ParameterRow {
  return parameter.form === 'choice' ? new ChoiceRow(parameter, setValue) : new NumberRow(parameter, setValue);
}

// Parameters of the same shape differ only in their numbers and can share a row.
export function shapeOf({ path, form, choices, unit, low, high, label, group, restarts }: LabParameter) {
  return [path, form, choices, unit, low, high, label, group, restarts];
}
