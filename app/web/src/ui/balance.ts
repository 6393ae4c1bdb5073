// Every wrench on a body, as a table; its colours are those of the arrows in the picture.
import type { Balance } from '../data/inspection';
import { element, short } from './dom';
import './inspection.css';
import { token } from './theme';

const COLORS = 8;

export function wrenchColor(i: number): string {
  return token(`--c${i % COLORS}`);
}

// With its number: colours alone do not tell eight apart.
export function swatch(i: number): HTMLElement {
  const number = element('b', {}, String(i + 1));
  const made = element('i', { class: 'swatch' }, number);
  made.style.color = `var(--c${i % COLORS})`;
  return made;
}

export function balanceTable(
  { body, wrenches, residual, largest }: Balance,
  axes: string,
  about: string,
): HTMLElement {
  const numbers = (values: number[]) =>
    values.map((value) =>
      element('td', { class: 'number', title: String(value) }, short(value, largest)),
    );
  const rows = wrenches.map(({ source, force, torque }, i) =>
    element(
      'tr',
      {},
      element('th', { scope: 'row' }, swatch(i), source),
      ...numbers(force),
      ...numbers(torque),
    ),
  );
  const heads = ['', 'Fx', 'Fy', 'Fz [N]', 'Tx', 'Ty', 'Tz [N m]'];
  const sum = `They add up to ${short(residual)} of the largest (${short(largest)}).`;
  return element(
    'div',
    {},
    element(
      'h3',
      {},
      `Every wrench on ${body}`,
      element('span', {}, ` ${axes} axes, about ${about}`),
    ),
    element(
      'table',
      {},
      element('thead', {}, element('tr', {}, ...heads.map((head) => element('th', {}, head)))),
      element('tbody', {}, ...rows),
    ),
    element('p', { class: 'hint' }, sum),
  );
}
