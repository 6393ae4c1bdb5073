// Tables of the inspector: joint forces, contacts, energy, results of a pass, wrenches, cross-checks.
import type { AdjacentBody, Balance, Check, JointBalance, NamedForce, PassStep } from '../protocol/inspection';
import { NUMERICAL } from '../protocol/run';
import { EnergyTable, inOrder } from '../panels/balances';
import { element, largestOf, short, unitText } from '../ui/dom';
import { numberCell, row, table } from '../ui/table';
import { quantityCard } from './quantity';

const NOT_UNIQUE = 'Not unique: other contact forces give the same accelerations; only their sum is determined.';

function numbers(values: number[], scale = 0): HTMLElement[] {
  return values.map((value) => numberCell(value, scale));
}

export function jointTables(balances: JointBalance[]): HTMLElement[] {
  return balances.map(({ joint, component, unit, torques, residual }) => {
    const name = balances.length > 1 ? `${joint}, ${component + 1}` : joint;
    const max = largestOf(torques.map(({ value }) => value));
    const rows = torques.map(({ source, value }) => row(source, numberCell(value, max)));
    return element(
      'div',
      table([`along ${name || 'the joint'}`, `[${unitText(unit)}]`], rows),
      element('p.hint', `Residual: ${short(residual)} of the largest.`),
    );
  });
}

// The normal points to this body.
export function contactTables(forces: NamedForce[], body: string): HTMLElement[] {
  return forces
    .filter((force) => force.axis && force.on.some((on) => on.body === body))
    .map(({ source: name, point, axis, normal, friction, unique, on }) => {
      const { force } = on.find((end) => end.body === body)!;
      const along = force.reduce((sum, part, k) => sum + part * axis![k], 0);
      const outward = axis!.map((part) => (along < 0 ? -part : part) + 0);
      const line = (what: string, values: number[]) => row(what, ...numbers(values, largestOf(values)));
      const ratio = normal ? `, |Ft|/N ${short((friction ?? 0) / normal)}` : '';
      return element(
        'div.contact',
        element('h4', name.replace('contact/', '')),
        element('p', `normal force N ${short(normal)} N, friction |Ft| ${short(friction)} N${ratio}`),
        unique === false ? element('p.hint', NOT_UNIQUE) : '',
        table(
          ['world axes', 'x', 'y', 'z'],
          [line('point [m]', point ?? []), line('normal', outward), line('force [N]', force)],
        ),
      );
    });
}

// The largest first, without rows that are zero.
export function energyTable(energy_balance: Record<string, number>): HTMLElement {
  const all = Object.entries(energy_balance);
  const rows = inOrder(all.filter(([name, work]) => work !== 0 || name === NUMERICAL));
  const made = new EnergyTable(rows.map(([name]) => name));
  const works = rows.map(([, work]) => work);
  made.show(works, largestOf(works));
  const idle = all.length - rows.length;
  return element('div', made.root, element('p.hint', idle > 0 ? `${idle} more rows are zero.` : ''));
}

const halves = (v: number[]) => [v.slice(0, 3), v.slice(3)];
const length = (values: number[]) => Math.hypot(...values);
const one = (value: unknown) => (typeof value === 'number' ? value : NaN); // one degree of freedom
// Columns of the table of each pass.
const SUMMARY: Record<number, { of: string; heads: string[]; read: (value: never) => number[] }[]> = {
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

// Results of a pass up to the current body; later ones are not computed yet.
export function passTable(rows: Omit<PassStep, 'joint'>[], body: string): HTMLElement {
  const { pass } = rows[0];
  const at = rows.findIndex((step) => step.body === body);
  const summary = SUMMARY[pass];
  const lines = rows.map((step, i) => {
    const cells = summary.flatMap(({ of, heads, read }) => {
      const found = step.quantities.find(({ name }) => name === of);
      if (i > at) return heads.map(() => element('td.number.later', '·'));
      return numbers(found ? read(found.value as never) : heads.map(() => NaN));
    });
    const name = element('button', { type: 'button', 'data-body': step.body }, step.body);
    const line = row([name], ...cells);
    if (i === at) line.setAttribute('aria-current', 'step');
    return line;
  });
  return table(['', ...summary.flatMap(({ heads }) => heads)], lines);
}

// Quantities of parent and children that the pass uses.
const INPUTS: Record<number, string[]> = { 1: ['v'], 2: ['Xup', 'Ia', 'pa'], 3: ['a'] };
export function adjacentCards(bodies: AdjacentBody[], pass: number): HTMLElement[] {
  return bodies.flatMap(({ body, is, quantities }) => {
    const used = quantities.filter(({ name }) => INPUTS[pass].includes(name));
    const title = element('h4', `${is} ${body}`, element('span', ' in its own axes'));
    const cards = used.map((quantity) => quantityCard(quantity));
    return used.length > 0 ? [element('div.adjacent', title, ...cards)] : [];
  });
}

// Numbered, since colours alone may not be distinguishable; the arrows in the 3-D view have them too.
function swatch(i: number): HTMLElement {
  const made = element('i.swatch', element('b', String(i + 1)));
  made.style.color = `var(--c${i % 8})`;
  return made;
}

export function balanceTable(balance: Balance, axes: string, about: string): HTMLElement {
  const { body, wrenches, largest } = balance;
  const rows = wrenches.map(({ source, force, torque }, i) =>
    row([swatch(i), source], ...[...force, ...torque].map((value) => numberCell(value, largest)))
  );
  const heads = ['', 'Fx', 'Fy', 'Fz [N]', 'Tx', 'Ty', 'Tz [N m]'];
  const title = element('span', ` ${axes} axes, about ${about}`);
  return element('div', element('h3', `Wrenches on ${body}`, title), table(heads, rows));
}

export function checkSummary(checks: Check[]): string {
  const failed = checks.filter((check) => !check.pass).length;
  return failed > 0 ? `${failed} of ${checks.length} failed` : `${checks.length} passed`;
}

export function checkTable(checks: Check[], warnings: string[]): HTMLElement {
  const heads = ['', 'independent computation', 'error', 'tolerance', 'largest error at'];
  const rows = checks.map(({ pass, name, meaning, error, tolerance, body }) => {
    const [what, where] = [element('td', meaning), element('td', body)];
    const made = row(`${pass ? '✓' : '✗'} ${name}`, what, numberCell(error), numberCell(tolerance), where);
    made.classList.toggle('short', !pass);
    return made;
  });
  const notes = warnings.map((text) => element('p.note', text));
  return element('section.checks', ...notes, table(heads, rows));
}
