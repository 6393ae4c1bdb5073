// Tables of the inspector: joint torques, contacts, energy, results of a pass so far, wrenches, checks.
import type { Balance, Check, JointBalance, NamedForce, Neighbour, PassStep } from '../protocol/inspection';
import { NUMERICAL } from '../protocol/run';
import { EnergyTable, inOrder } from '../panels/balances';
import { element, largestOf, short, unitText } from '../ui/dom';
import { numberCell, row, table } from '../ui/table';
import { quantityCard } from './quantity';
import { token } from '../ui/preferences';

function numbers(values: number[], scale = 0): HTMLElement[] {
  return values.map((value) => numberCell(value, scale));
}

export function jointTables(balances: JointBalance[], unit: string): HTMLElement[] {
  return balances.map(({ joint, component, torques, residual }) => {
    const name = balances.length > 1 ? `${joint}, ${component + 1}` : joint;
    const most = largestOf(torques.map(({ value }) => value));
    const rows = torques.map(({ source: who, value }) => row(who, numberCell(value, most)));
    return element(
      'div',
      table([`along ${name || 'its joint'}`, `[${unitText(unit)}]`], rows),
      element('p.hint', `They add up to ${short(residual)} of the largest.`),
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
      const line = (what: string, values: number[]) => row(what, ...numbers(values, largestOf(values)));
      const share = normal ? `, ${short((friction ?? 0) / normal)} of it` : '';
      return element(
        'div.contact',
        { 'data-contact': name },
        element('h4', name.replace('contact/', '')),
        element('p', `presses with ${short(normal)} N, rubs with ${short(friction)} N${share}`),
        table(
          ['world axes', 'x', 'y', 'z'],
          [line('point [m]', point ?? []), line('normal', outward), line('force [N]', force)],
        ),
      );
    });
}

// The largest first; what did no work is only counted.
export function energyTable(ledger: Record<string, number>): HTMLElement {
  const all = Object.entries(ledger);
  const rows = inOrder(all.filter(([name, work]) => work !== 0 || name === NUMERICAL));
  const made = new EnergyTable(rows.map(([name]) => name));
  const works = rows.map(([, work]) => work);
  made.show(works, largestOf(works));
  const idle = all.length - rows.length;
  const words = idle > 0 ? `${idle} more did no work.` : '';
  return element('div', made.root, element('p.hint', words));
}

const halves = (v: number[]) => [v.slice(0, 3), v.slice(3)];
const length = (values: number[]) => Math.hypot(...values);
// Of several velocities the units differ.
const one = (value: unknown) => (typeof value === 'number' ? value : NaN);
// Of each pass, what a glance at a body tells.
const TOLD: Record<number, { of: string; heads: string[]; read: (value: never) => number[] }[]> = {
  1: [{ of: 'v', heads: ['|w| [rad/s]', '|v| [m/s]'], read: (v: number[]) => halves(v).map(length) }],
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
export function soFar(rows: Omit<PassStep, 'joint'>[], body: string): HTMLElement {
  const { pass } = rows[0];
  const at = rows.findIndex((step) => step.body === body);
  const told = TOLD[pass];
  const lines = rows.map((step, i) => {
    const cells = told.flatMap(({ of, heads, read }) => {
      const found = step.quantities.find(({ name }) => name === of);
      if (i > at) return heads.map(() => element('td.number.later', '·'));
      return numbers(found ? read(found.value as never) : heads.map(() => NaN));
    });
    const name = element('button', { type: 'button', 'data-body': step.body }, step.body);
    const line = row([name], ...cells);
    if (i === at) line.setAttribute('aria-current', 'step');
    return line;
  });
  return table(['', ...told.flatMap(({ heads }) => heads)], lines);
}

// What the pass takes from the bodies beside this one, in their own axes.
const TAKEN: Record<number, string[]> = { 1: ['v'], 2: ['Xup', 'Ia', 'pa'], 3: ['a'] };
export function neighbourCards(neighbours: Neighbour[], pass: number): HTMLElement[] {
  return neighbours.flatMap(({ body, is, quantities }) => {
    const taken = quantities.filter(({ name }) => TAKEN[pass].includes(name));
    const title = element('h4', `${is} ${body}`, element('span', ' in its own axes'));
    const cards = taken.map((quantity) => quantityCard(quantity));
    return taken.length > 0 ? [element('div.neighbour', title, ...cards)] : [];
  });
}

// Every wrench on a body, as a table; its colours are those of the arrows in the picture.
const COLORS = 8;

export function wrenchColor(i: number): string {
  return token(`--c${i % COLORS}`);
}

// With its number: colours alone do not tell eight apart.
function swatch(i: number): HTMLElement {
  const made = element('i.swatch', element('b', String(i + 1)));
  made.style.color = `var(--c${i % COLORS})`;
  return made;
}

export function balanceTable(balance: Balance, axes: string, about: string): HTMLElement {
  const { body, wrenches, residual, largest } = balance;
  const rows = wrenches.map(({ source, force, torque }, i) =>
    row([swatch(i), source], ...[...force, ...torque].map((value) => numberCell(value, largest))),
  );
  const heads = ['', 'Fx', 'Fy', 'Fz [N]', 'Tx', 'Ty', 'Tz [N m]'];
  const title = element('span', ` ${axes} axes, about ${about}`);
  const sum = element('p.hint', `They add up to ${short(residual)} of the largest (${short(largest)}).`);
  return element('div', element('h3', `Every wrench on ${body}`, title), table(heads, rows), sum);
}

// Checks by second ways, and warnings.
export function checkWords(checks: Check[]): string {
  const failed = checks.filter((check) => !check.pass).length;
  return failed > 0 ? `${failed} of ${checks.length} fall short` : `${checks.length} pass`;
}

export function checkTable(checks: Check[], warnings: string[]): HTMLElement {
  const heads = ['', 'found by a second way', 'error', 'tolerance', 'worst at'];
  const rows = checks.map(({ pass, name, meaning, error, tolerance, body }) => {
    const [what, where] = [element('td', meaning), element('td', body)];
    const made = row(`${pass ? '✓' : '✗'} ${name}`, what, numberCell(error), numberCell(tolerance), where);
    made.classList.toggle('short', !pass);
    return made;
  });
  const notes = warnings.map((text) => element('p.note', text));
  return element('section.checks', ...notes, table(heads, rows));
}
