// Every wrench on a body, as a table; its colours are those of the arrows in the picture.
import type { Balance } from '../protocol/inspection';
import { element, short } from '../ui/dom';
import { numberCell, row, table } from '../ui/table';
import { token } from '../ui/theme';

const COLORS = 8;

export function wrenchColor(i: number): string {
  return token(`--c${i % COLORS}`);
}

// With its number: colours alone do not tell eight apart.
export function swatch(i: number): HTMLElement {
  const number = element('b', String(i + 1));
  const made = element('i.swatch', number);
  made.style.color = `var(--c${i % COLORS})`;
  return made;
}

export function balanceTable(
  { body, wrenches, residual, largest }: Balance,
  axes: string,
  about: string,
): HTMLElement {
  const rows = wrenches.map(({ source, force, torque }, i) =>
    row([swatch(i), source], ...[...force, ...torque].map((value) => numberCell(value, largest))),
  );
  const heads = ['', 'Fx', 'Fy', 'Fz [N]', 'Tx', 'Ty', 'Tz [N m]'];
  const title = element('span', ` ${axes} axes, about ${about}`);
  const sum = `They add up to ${short(residual)} of the largest (${short(largest)}).`;
  return element(
    'div',
    element('h3', `Every wrench on ${body}`, title),
    table(heads, rows),
    element('p.hint', sum),
  );
}
