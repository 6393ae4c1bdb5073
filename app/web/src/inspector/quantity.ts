// Card of a quantity: scalar, vectors or matrix (as heat map), with a tooltip of unit, frame and equation.
import './quantity.css';
import type { Quantity } from '../protocol/inspection';
import { element, largestOf, short, unitText } from '../ui/dom';
import { numberCell, table } from '../ui/table';
import { math, source } from './math';

export type Numbers = Pick<Quantity, 'value' | 'unit'> & { frame?: string };

const AXES = ['x', 'y', 'z'];

// Angular part first, as in RBDA; each half has its unit.
function six(values: number[], unit: string): HTMLElement {
  const units = unit.split(';').map((text) => text.trim());
  const rows = [values.slice(0, 3), values.slice(3)].map((half, i) => {
    const unitCell = element('td.unit', unitText(units[i] ?? units[0]));
    return element('tr', ...half.map((value) => numberCell(value)), unitCell);
  });
  return table([...AXES, ''], rows, { class: 'six' });
}

// Colours relative to the maximum of each 3 x 3 block, since blocks have different units.
function heat(rows: number[][]): HTMLElement {
  const three = <T>(all: T[], i: number) => all.slice(i - (i % 3), i - (i % 3) + 3);
  const cell = (value: number, i: number, k: number) => {
    const max = largestOf(three(rows, i).flatMap((row) => three(row, k)));
    const share = max > 0 ? Math.abs(value) / max : 0;
    const made = numberCell(value, 0, value < 0 ? 'minus' : 'plus');
    made.style.setProperty('--share', `${Math.round(62 * share)}%`);
    if (share < 1e-12) made.classList.add('none');
    return made;
  };
  const lines = rows.map((row, i) => element('tr', ...row.map((value, k) => cell(value, i, k))));
  return element('table.heat', element('tbody', ...lines));
}

// Units of both halves of six numbers. `unit` is "angular; linear"; the coordinates of a free joint are
// linear first.
export function unitOfSix({ value, unit, frame }: Numbers): string {
  const isJoint = frame === 'joint' && Array.isArray(value) && value.length === 6;
  return isJoint ? unit.split(';').reverse().join(';') : unit;
}

export function shownValue(quantity: Numbers): HTMLElement {
  const { value } = quantity;
  const unit = unitOfSix(quantity);
  if (typeof value === 'number')
    return element('p.one', { title: String(value) }, short(value), ` ${unitText(unit)}`);
  if (Array.isArray(value[0])) {
    const rows = value as number[][];
    const isList = rows[0].length === 6 && rows.length !== 6;
    return isList ? element('div', ...rows.map((row) => six(row, unit))) : heat(rows);
  }
  const numbers = value as number[];
  if (numbers.length === 6) return six(numbers, unit);
  const parts = numbers.map((n) => element('span', { title: String(n) }, `${short(n)}, `));
  return element('p.one', ...parts, unitText(unit));
}

// `content` replaces the plain numbers.
export function quantityCard(quantity: Quantity, content?: Node[]): HTMLElement {
  const { name, meaning, unit, frame, equation } = quantity;
  const facts = { meaning, unit: unit.replaceAll('^2', '²'), frame, equation: source(equation) };
  const lines = Object.entries(facts).flatMap(([name, fact]) => [element('dt', name), element('dd', fact)]);
  const tip = element('dl.tip', { role: 'tooltip' }, ...lines);
  return element(
    'article.quantity',
    { tabindex: '0', 'data-quantity': name, 'aria-label': `${name}: ${meaning}` },
    element('h4', math(name), element('span.fine', meaning)),
    ...(content ?? [shownValue(quantity)]),
    tip,
  );
}
