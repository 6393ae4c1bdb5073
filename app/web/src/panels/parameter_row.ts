// One knob: its name, its control, and beside it what is predicted for its value.
import { changeDetector, element, icon, option, signed, unitText } from '../ui/dom';
import { isTurned, type Knob } from '../source/link';
import { numberText, parseNumber, placeOf, type Scale, stepped, valueAt } from '../ui/scale';
import { putMark, Slider } from '../ui/slider';
import { Segments } from '../ui/choices';

const SETTLE = 800; // for so long the lab may take to say the value that was set [ms]
const FEW = 3; // choices that stand side by side, if they have room: letters and gaps [pixels]
const ROOM = 250;
const LETTER = 7.4;
const GAP = 20;
const RESTARTS = 'restarts: the run goes on from where all is, what laws remember begins anew';

type Turn = (path: string, value: string) => void;

export abstract class ParameterRow {
  readonly root = element('div.knob');
  protected readonly side = element('div.predicted', { 'aria-live': 'polite' });
  private readonly isNew = changeDetector();
  private setAt = -Infinity;

  constructor(protected knob: Knob, private readonly turn: Turn) {
    this.root.dataset.path = knob.path;
  }

  // The lab's value, unless it is just being changed here.
  update(knob: Knob): void {
    this.knob = knob;
    if (!this.isHeld() && performance.now() - this.setAt > SETTLE) this.show(knob.value);
    else if (String(knob.value) === this.sent) this.setAt = -Infinity;
    this.tell(knob);
  }

  protected begin(): void {
    this.show(this.knob.value);
    this.update(this.knob);
  }

  focus(): void {
    this.root.querySelector<HTMLElement>('input, select, [tabindex="0"]')?.focus();
  }

  enable(on: boolean): void {
    for (const control of this.root.querySelectorAll('input, select, button'))
      control.toggleAttribute('disabled', !on);
  }

  // Many couplings have a stiffness.
  protected get fullName(): string {
    return `${this.knob.group}: ${this.knob.label}`;
  }

  protected sent = '';
  protected set(value: string): void {
    this.sent = value;
    this.setAt = performance.now();
    this.turn(this.knob.path, value);
  }

  protected abstract show(value: Knob['value']): void;
  protected abstract isHeld(): boolean;
  protected limited(_limit: number | null): void {}

  protected head(control: HTMLElement[], id?: string): void {
    const { label, meaning, restarts } = this.knob;
    const name = element(id ? 'label' : 'span', { class: 'name', title: meaning }, label);
    if (id) name.setAttribute('for', id);
    if (restarts) {
      const attributes = { role: 'img', title: RESTARTS, 'aria-label': RESTARTS };
      name.append(element('span.restarts', attributes, icon('again')));
    }
    this.root.append(name, ...control, this.side);
  }

  private tell(knob: Knob): void {
    const { limit, lag, start, unit } = knob;
    const turned = isTurned(knob);
    if (!this.isNew(limit, lag, turned)) return;
    const lines: HTMLElement[] = [];
    if (limit) lines.push(signed(limit.state, limit.words));
    if (lag) lines.push(element('span.lag', `lag ${lag}`));
    const from = start ? `${start} ${unitText(unit)}` : 'left out';
    if (turned) lines.push(element('span.from', `the scene: ${from.trim()}`));
    this.root.classList.toggle('turned', turned);
    this.side.replaceChildren(...lines);
    this.root.dataset.limit = limit?.state ?? '';
    this.limited(limit?.value ?? null);
  }
}

// A slider, where there is a range, and a field for digits.
class NumberRow extends ParameterRow {
  private readonly scale: Scale | null;
  private readonly slider: Slider | null;
  private readonly mark = element('i.mark', { 'aria-hidden': 'true' });
  private readonly field: HTMLInputElement;
  private value = NaN;

  constructor(knob: Knob, turn: Turn) {
    super(knob, turn);
    const { form, low, high, path, unit } = knob;
    const hasRange = low !== undefined && high !== undefined && high > low;
    this.scale = hasRange && (form === 'log' || form === 'linear') ? { form, low, high } : null;
    const id = `knob-${path.replaceAll(/[^\w]/g, '-')}`;
    this.field = element('input', {
      type: 'text',
      id,
      inputmode: 'decimal',
      autocomplete: 'off',
      spellcheck: 'false',
      placeholder: '–',
      'aria-label': `${this.fullName}${unit && unit !== '1' ? ` in ${unit}` : ''}`,
      title: `${knob.meaning}. Enter sets it, Escape leaves it; arrows change it`,
    });
    const { scale } = this;
    const slide = (place: number) => this.put(valueAt(scale!, place));
    this.slider = scale && new Slider(this.fullName, slide, this.mark);
    const words = element('span.unit', unitText(unit));
    const number = element('div.number', this.field, words);
    this.head(this.slider ? [this.slider.root, number] : [number], id);
    this.listen();
    this.begin();
  }

  protected isHeld(): boolean {
    return this.slider?.isHeld || document.activeElement === this.field;
  }

  protected show(value: Knob['value']): void {
    this.value = value === null ? NaN : Number(value);
    this.field.value = value === null ? '' : numberText(this.value);
    this.field.setCustomValidity('');
    if (!this.scale || !this.slider) return;
    const place = placeOf(this.scale, this.value);
    this.slider.put(place);
    this.slider.fill(place, `${this.field.value} ${this.knob.unit}`);
  }

  protected limited(limit: number | null): void {
    const { scale } = this;
    const isShown = scale && limit !== null && limit >= scale.low && limit <= scale.high;
    putMark(this.mark, isShown ? placeOf(scale, limit) : null);
    this.mark.title = limit === null ? '' : `limit ${numberText(limit)} ${this.knob.unit}`;
  }

  private put(value: number): void {
    this.show(value);
    this.set(String(value));
  }

  private listen(): void {
    const { slider, field } = this;
    field.addEventListener('focus', () => {
      if (!Number.isNaN(this.value)) field.value = String(this.value); // all digits
      field.select();
    });
    field.addEventListener('input', () => field.setCustomValidity(''));
    field.addEventListener('blur', () => this.show(this.knob.value));
    // Before the page's own keys.
    for (const at of [slider?.input, field])
      at?.addEventListener('keydown', (event) => this.press(event));
  }

  private press(event: KeyboardEvent): void {
    const isField = event.target === this.field;
    const way = { ArrowUp: 1, ArrowRight: 1, PageUp: 1, ArrowDown: -1, ArrowLeft: -1, PageDown: -1 };
    const sideways = event.key === 'ArrowLeft' || event.key === 'ArrowRight';
    if (isField && event.key === 'Enter') this.commit();
    else if (isField && event.key === 'Escape') {
      this.show(this.knob.value);
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

  // Of a number without a range: about its size.
  private near(): Scale {
    const size = Math.abs(this.value) || 1;
    return { form: 'linear', low: -5 * size, high: 5 * size };
  }

  private commit(): void {
    const { unit } = this.knob;
    const value = parseNumber(this.field.value, unit);
    const words = unit && unit !== '1' ? `a number in ${unitText(unit)}` : 'a number';
    this.field.setCustomValidity(Number.isNaN(value) ? words : '');
    if (!this.field.reportValidity()) return;
    this.put(value);
    this.field.select();
  }
}

// Buttons side by side, or a list where they are many.
class ChoiceRow extends ParameterRow {
  private readonly control: Segments | HTMLSelectElement;
  private readonly left = element('option', { value: '', disabled: '' }, 'as the scene leaves it');

  constructor(knob: Knob, turn: Turn) {
    super(knob, turn);
    const choices = knob.choices ?? [];
    const letters = choices.join('').length;
    if (choices.length <= FEW && LETTER * letters + GAP * choices.length < ROOM) {
      this.control = new Segments(this.fullName, choices, '', (name) => this.set(name));
      this.head([this.control.root]);
    } else {
      const attributes = { 'aria-label': this.fullName, title: knob.meaning };
      const list = element('select', attributes, this.left, ...choices.map((name) => option(name)));
      list.addEventListener('change', () => this.set(list.value));
      this.control = list;
      this.head([list]);
    }
    this.root.classList.add('choice');
    this.begin();
  }

  protected isHeld(): boolean {
    return false;
  }
  protected show(value: Knob['value']): void {
    if (this.control instanceof Segments) this.control.show(String(value));
    else {
      const name = String(value ?? '');
      const isOffered = this.knob.choices?.includes(name) ?? false;
      this.left.hidden = isOffered;
      this.control.value = isOffered ? name : '';
    }
  }
}

export function parameterRow(knob: Knob, turn: Turn): ParameterRow {
  return knob.form === 'choice' ? new ChoiceRow(knob, turn) : new NumberRow(knob, turn);
}

// Two that differ only by their numbers can be shown by the same row.
export function shapeOf({ path, form, choices, unit, low, high, label, group, restarts }: Knob) {
  return [path, form, choices, unit, low, high, label, group, restarts];
}
