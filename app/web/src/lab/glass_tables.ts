// What else acts on the body: along its joint, in contacts, in joules; and what a pass has found so
// far.
import type { CallStep, Neighbour } from '../data/glass';
import type { JointBalance, NamedForce, Quantity } from '../data/inspection';
import { NUMERICAL } from '../data/run';
import { element, largestOf, short, unitText } from '../ui/dom';
import { math, source, texOf } from '../ui/formula';
import { quantityCard } from '../ui/quantity';

function numbers(values: number[], scale = 0): HTMLElement[] {
  return values.map((value) =>
    element('td', { class: 'number', title: String(value) }, short(value, scale)),
  );
}

function table(heads: string[], rows: HTMLElement[]): HTMLElement {
  const head = element('tr', {}, ...heads.map((text) => element('th', { scope: 'col' }, text)));
  return element('table', {}, element('thead', {}, head), element('tbody', {}, ...rows));
}

export function jointTables(balances: JointBalance[], unit: string): HTMLElement[] {
  return balances.map(({ joint, component, torques, residual }) => {
    const name = balances.length > 1 ? `${joint}, ${component + 1}` : joint;
    const most = largestOf(torques.map(({ value }) => value));
    const rows = torques.map(({ source: who, value }) =>
      element('tr', {}, element('th', { scope: 'row' }, who), ...numbers([value], most)),
    );
    return element(
      'div',
      {},
      table([`along ${name || 'its joint'}`, `[${unitText(unit)}]`], rows),
      element('p', { class: 'hint' }, `They add up to ${short(residual)} of the largest.`),
    );
  });
}

// The normal as it comes out of the other body: what presses goes along it.
export function contactTables(forces: NamedForce[], body: string): HTMLElement[] {
  return forces
    .filter((force) => force.axis && force.on.some((on) => on.body === body))
    .map(({ source: name, point, axis, normal, friction, on }) => {
      const { force } = on.find((end) => end.body === body)!;
      const along = force.reduce((sum, part, k) => sum + part * axis![k], 0);
      const outward = axis!.map((part) => (along < 0 ? -part : part) + 0);
      const row = (what: string, values: number[]) =>
        element('tr', {}, element('th', { scope: 'row' }, what), ...numbers(values, largestOf(values)));
      const share = normal ? `, ${short((friction ?? 0) / normal)} of it` : '';
      return element(
        'div',
        { class: 'contact', 'data-contact': name },
        element('h4', {}, name.replace('contact/', '')),
        element('p', {}, `presses with ${short(normal)} N, rubs with ${short(friction)} N${share}`),
        table(
          ['world axes', 'x', 'y', 'z'],
          [row('point [m]', point ?? []), row('normal', outward), row('force [N]', force)],
        ),
      );
    });
}

// The largest first; the remainder last.
export function ledgerTable(ledger: Record<string, number>): HTMLElement {
  const rank = (name: string) => (name === NUMERICAL ? 1 : 0);
  const all = Object.entries(ledger).sort(
    ([a, x], [b, y]) => rank(a) - rank(b) || Math.abs(y) - Math.abs(x),
  );
  const rows = all.filter(([name, work]) => work !== 0 || rank(name) === 1);
  const largest = Math.max(1e-300, ...rows.map(([, work]) => Math.abs(work)));
  const lines = rows.map(([name, work]) => {
    const bar = element('i', { class: work < 0 ? 'minus' : 'plus' });
    bar.style.width = `${(50 * Math.abs(work)) / largest}%`;
    return element(
      'tr',
      {},
      element('th', { scope: 'row' }, name),
      ...numbers([work]),
      element('td', { class: 'bar' }, bar),
    );
  });
  const sum = rows.reduce((total, [, work]) => total + work, 0);
  const idle = all.length - rows.length;
  const foot = element('th', { scope: 'row' }, 'their sum: rise of kinetic energy');
  const made = table(['work since the start', '[J]', ''], lines);
  made.append(element('tfoot', {}, element('tr', {}, foot, ...numbers([sum]), element('td'))));
  const words = idle > 0 ? `${idle} more did no work.` : '';
  return element('div', {}, made, element('p', { class: 'hint' }, words));
}

const length = (values: number[]) => Math.hypot(...values);
// Of several velocities the units differ.
const one = (value: unknown) => (typeof value === 'number' ? value : NaN);
// Of each pass, what a glance at a body tells.
const TOLD: Record<number, { of: string; heads: string[]; read: (value: never) => number[] }[]> = {
  1: [
    {
      of: 'v',
      heads: ['|w| [rad/s]', '|v| [m/s]'],
      read: (v: number[]) => [length(v.slice(0, 3)), length(v.slice(3))],
    },
  ],
  2: [
    { of: 'D', heads: ['D'], read: (D: unknown) => [one(D)] },
    { of: 'u', heads: ['u'], read: (u: unknown) => [one(u)] },
  ],
  3: [
    { of: 'qdd', heads: ["q''"], read: (qdd: unknown) => [one(qdd)] },
    { of: 'acceleration', heads: ['|acceleration| [m/s²]'], read: (a: number[]) => [length(a)] },
  ],
};

// Row by row as the call goes on: what comes later is not known yet.
export function soFar(rows: CallStep[], body: string): HTMLElement {
  const { pass } = rows[0];
  const at = rows.findIndex((row) => row.body === body);
  const told = TOLD[pass];
  const lines = rows.map((row, i) => {
    const cells = told.flatMap(({ of, heads, read }) => {
      const found = row.quantities.find(({ name }) => name === of);
      if (i > at) return heads.map(() => element('td', { class: 'number later' }, '·'));
      return numbers(found ? read(found.value as never) : heads.map(() => NaN));
    });
    const name = element('button', { type: 'button', 'data-body': row.body }, row.body);
    return element(
      'tr',
      i === at ? { 'aria-current': 'step' } : {},
      element('th', { scope: 'row' }, name),
      ...cells,
    );
  });
  return table(['', ...told.flatMap(({ heads }) => heads)], lines);
}

// What the pass takes from the bodies beside this one, in their own axes.
const TAKEN: Record<number, string[]> = { 1: ['v'], 2: ['Xup', 'Ia', 'pa'], 3: ['a'] };
export function neighbourCards(neighbours: Neighbour[], pass: number): HTMLElement[] {
  return neighbours
    .map(({ body, is, quantities }): [string, Quantity[]] => [
      `${is} ${body}`,
      quantities.filter(({ name }) => TAKEN[pass].includes(name)),
    ])
    .filter(([, quantities]) => quantities.length > 0)
    .map(([title, quantities]) =>
      element(
        'div',
        { class: 'neighbour' },
        element('h4', {}, title, element('span', {}, ' in its own axes')),
        ...quantities.map((quantity) =>
          quantityCard(quantity, {
            symbol: math(texOf(quantity.name)),
            equation: source(quantity.equation),
          }),
        ),
      ),
    );
}
