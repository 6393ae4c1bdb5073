// Tables of numbers; the tooltip of a cell has all digits.
import './table.css';
import { element, short } from './dom';

export function numberCell(value: number | null, scale = 0, more = ''): HTMLTableCellElement {
  const made = element('td', { class: `number ${more}`.trim() });
  putNumber(made, value, scale);
  return made;
}

export function putNumber(cell: HTMLElement, value: number | null, scale = 0): void {
  cell.textContent = short(value, scale);
  cell.title = String(value);
}

// Scrolls sideways, also by keyboard.
export function wide(name: string, content: Node): HTMLElement {
  return element('div.wide', { tabindex: '0', role: 'group', 'aria-label': name }, content);
}

export function row(head: string | (Node | string)[], ...cells: Node[]): HTMLTableRowElement {
  return element('tr', element('th', { scope: 'row' }, ...[head].flat()), ...cells);
}

export function table(
  heads: (string | HTMLElement)[],
  rows: Node[],
  attributes: Record<string, string> = {},
  foot?: Node,
): HTMLTableElement {
  const cells = heads.map((head) => typeof head === 'string' ? element('th', { scope: 'col' }, head) : head);
  return element(
    'table',
    attributes,
    element('thead', element('tr', ...cells)),
    element('tbody', ...rows),
    ...(foot ? [element('tfoot', foot)] : []),
  );
}
