// A quantity of a pass: numbers by their shape, 6 x 6 as a map of its sizes; unit, frame and
// equation at the pointer.
import './quantity.css';
import type { Quantity } from '../protocol/inspection';
import { element, short, unitText } from '../ui/dom';
import { numberCell, table } from '../ui/table';

export type Numbers = Pick<Quantity, 'value' | 'unit'> & { frame?: string };

const AXES = ['x', 'y', 'z'];

// Angular part first, as in the book; each half has a unit of its own.
function six(values: number[], unit: string): HTMLElement {
  const units = unit.split(';').map((text) => text.trim());
  const rows = [values.slice(0, 3), values.slice(3)].map((half, i) =>
    element(
      'tr',
      ...half.map((value) => numberCell(value)),
      element('td.unit', unitText(units[i] ?? units[0])),
    ),
  );
  return table([...AXES, ''], rows, { class: 'six' });
}

// Colours by the size within each 3 x 3 block: blocks have different units.
export function heat(rows: number[][]): HTMLElement {
  const largest = new Map<string, number>();
  const block = (i: number, k: number) => `${Math.floor(i / 3)}${Math.floor(k / 3)}`;
  rows.forEach((row, i) =>
    row.forEach((value, k) =>
      largest.set(block(i, k), Math.max(largest.get(block(i, k)) ?? 0, Math.abs(value))),
    ),
  );
  const lines = rows.map((row, i) =>
    element(
      'tr',
      ...row.map((value, k) => {
        const most = largest.get(block(i, k)) ?? 0;
        const share = most > 0 ? Math.abs(value) / most : 0;
        const made = numberCell(value, 0, value < 0 ? 'minus' : 'plus');
        made.style.setProperty('--share', `${Math.round(62 * share)}%`);
        if (share < 1e-12) made.classList.add('none');
        return made;
      }),
    ),
  );
  return element('table.heat', element('tbody', ...lines));
}

// Units of both halves of six numbers. Those of a joint (it floats) shift first and turn then; told
// is where a joint turns, and where it shifts.
export function unitOfSix({ value, unit, frame }: Numbers): string {
  const isJoint = frame === 'joint' && Array.isArray(value) && value.length === 6;
  return isJoint ? unit.split(';').reverse().join(';') : unit;
}

export function valueOf(quantity: Numbers): HTMLElement {
  const { value } = quantity;
  const unit = unitOfSix(quantity);
  if (typeof value === 'number')
    return element('p.one', { title: String(value) }, short(value), ` ${unitText(unit)}`);
  if (Array.isArray(value[0])) {
    const rows = value as number[][];
    if (rows.length === 6 && rows[0].length === 6) return heat(rows);
    if (rows[0].length === 6) return element('div', ...rows.map((row) => six(row, unit)));
    return heat(rows);
  }
  const numbers = value as number[];
  if (numbers.length === 6) return six(numbers, unit);
  const parts = numbers.map((n) => element('span', { title: String(n) }, `${short(n)}, `));
  return element('p.one', ...parts, unitText(unit));
}

// What a page has to say of it in its own way: nothing is left out where it says nothing.
export interface Telling {
  symbol?: Node; // as print sets it
  equation?: Node;
  content?: Node[]; // in the place of the numbers alone
}

export function quantityCard(quantity: Quantity, telling: Telling = {}): HTMLElement {
  const fact = (name: string, said: Node | string) => [element('dt', name), element('dd', said)];
  const tip = element(
    'dl.tip',
    { role: 'tooltip' },
    ...fact('is', quantity.meaning),
    ...fact('unit', quantity.unit.replaceAll('^2', '²')),
    ...fact('frame', quantity.frame),
    ...fact('from', telling.equation ?? quantity.equation),
  );
  return element(
    'article.quantity',
    { tabindex: '0', 'data-quantity': quantity.name, 'aria-label': `${quantity.name}: ${quantity.meaning}` },
    element('h4', telling.symbol ?? quantity.name, element('span', quantity.meaning)),
    ...(telling.content ?? [valueOf(quantity)]),
    tip,
  );
}
