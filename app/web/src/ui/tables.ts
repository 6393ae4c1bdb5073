// Tables beside the picture: the ledger, and what the run was made of.
import { NUMERICAL, type Run } from '../data/run';
import { button, element, short } from './dom';
import type { Player } from './player';

// Rows by the size of their work at the end; `numerical` last, as it is the remainder.
export class LedgerTable {
  readonly root = element('section', { class: 'ledger' });
  private readonly cells: { now: HTMLTableCellElement; bar: HTMLElement; row: number }[] = [];
  private readonly largest: number;
  private readonly sum = element('td', { class: 'number' });

  constructor(
    private readonly run: Run,
    private readonly player: Player,
  ) {
    const { rows, end, works } = run.ledger;
    this.largest = works.reduce((most, work) => Math.max(most, Math.abs(work)), 1e-300);
    const last = (row: number) => works[works.length - rows.length + row] ?? 0;
    const order = rows.map((_, row) => row);
    order.sort((a, b) => rank(rows[a]) - rank(rows[b]) || Math.abs(last(b)) - Math.abs(last(a)));
    const body = element('tbody');
    for (const row of order) {
      const now = element('td', { class: 'number' });
      const bar = element('i');
      const all = element('small', { 'data-row': rows[row], title: 'at the end' }, end[row]);
      body.append(
        element(
          'tr',
          {},
          element('th', { scope: 'row' }, rows[row], all),
          now,
          element('td', { class: 'bar' }, bar),
        ),
      );
      this.cells.push({ now, bar, row });
    }
    const heads = ['work, and below it all digits of the end [J]', 'now [J]', ''];
    const head = element('tr', {}, ...heads.map((text) => element('th', { scope: 'col' }, text)));
    this.root.append(
      element('h3', {}, 'Energy'),
      element(
        'p',
        { class: 'hint' },
        'From the start to the time shown. The rows add up to the change of kinetic energy; ' +
          '“numerical” is what is left over, the integrator’s error.',
      ),
      element(
        'table',
        {},
        element('thead', {}, head),
        body,
        element(
          'tfoot',
          {},
          element('tr', {}, element('th', { scope: 'row' }, 'their sum: rise of KE'), this.sum),
        ),
      ),
    );
  }

  show(): void {
    const { rows, works } = this.run.ledger;
    const begin = this.player.frame * rows.length;
    let sum = 0;
    for (const { now, bar, row } of this.cells) {
      const work = works[begin + row];
      sum += work;
      now.textContent = short(work);
      const share = (50 * Math.abs(work)) / this.largest;
      bar.className = work < 0 ? 'minus' : 'plus';
      bar.style.width = `${share}%`;
    }
    this.sum.textContent = short(sum);
  }
}

// The same of momentum: what pushed from outside, and how it turned about the origin.
export class MomentumTable {
  readonly root = element('section', { class: 'momentum' });
  private readonly cells: HTMLTableCellElement[][] = [];
  private readonly sums: HTMLTableCellElement[] = [];

  constructor(
    private readonly run: Run,
    private readonly player: Player,
  ) {
    const numbers = () => Array.from({ length: 6 }, () => element('td', { class: 'number' }));
    const row = (name: string, cells: HTMLTableCellElement[]) =>
      element('tr', {}, element('th', { scope: 'row' }, name), ...cells);
    const body = element('tbody');
    for (const name of run.momentum.rows) {
      this.cells.push(numbers());
      body.append(row(name, this.cells[this.cells.length - 1]));
    }
    this.sums = numbers();
    const heads = ['', 'x', 'y', 'z [N s]', 'about x', 'y', 'z [N m s]'];
    const head = element('tr', {}, ...heads.map((text) => element('th', { scope: 'col' }, text)));
    const foot = element('tfoot', {}, row('their sum: change of momentum', this.sums));
    const hint =
      'What acted from outside on all that forces move, up to the time shown; the moments are ' +
      'about the world’s origin. All digits stand at the pointer.';
    this.root.hidden = run.momentum.rows.length === 0;
    this.root.append(
      element('h3', {}, 'Momentum'),
      element('p', { class: 'hint' }, hint),
      element('div', { class: 'wide' }, element('table', {}, element('thead', {}, head), body, foot)),
    );
  }

  show(): void {
    const { rows, values } = this.run.momentum;
    const begin = 6 * this.player.frame * rows.length;
    const put = (cell: HTMLTableCellElement, value: number) => {
      cell.textContent = short(value);
      cell.title = String(value);
    };
    const sums = [0, 0, 0, 0, 0, 0];
    this.cells.forEach((cells, row) =>
      cells.forEach((cell, c) => {
        const value = values[begin + 6 * row + c];
        sums[c] += value;
        put(cell, value);
      }),
    );
    sums.forEach((sum, c) => put(this.sums[c], sum));
  }
}

function rank(name: string): number {
  return name === NUMERICAL ? 1 : 0;
}

function table(title: string, head: string[], rows: string[][]): HTMLElement {
  const heads = head.map((text) => element('th', { scope: 'col' }, text));
  const lines = rows.map((row) =>
    element('tr', {}, ...row.map((text, i) => element(i === 0 ? 'th' : 'td', {}, text))),
  );
  return element(
    'section',
    {},
    element('h3', {}, title),
    element(
      'div',
      { class: 'wide' },
      element(
        'table',
        {},
        element('thead', {}, element('tr', {}, ...heads)),
        element('tbody', {}, ...lines),
      ),
    ),
  );
}

export function setup(run: Run): HTMLElement {
  const root = element('section', { class: 'setup' });
  const copy = button('copy', 'copy the command', () => {
    void navigator.clipboard?.writeText(run.command);
  });
  root.append(
    element('h3', {}, 'Made by'),
    element('div', { class: 'command' }, element('code', { id: 'command' }, run.command), copy),
  );
  for (const note of run.notes) root.append(element('p', { class: 'note' }, note));
  const facts = element('dl');
  for (const [name, value] of run.facts)
    facts.append(element('dt', {}, name), element('dd', { 'data-fact': name }, value));
  root.append(facts);
  for (const { title, head, rows } of run.tables) root.append(table(title, head, rows));
  for (const file of run.files)
    root.append(
      element('details', {}, element('summary', {}, file.name), element('pre', {}, file.text)),
    );
  const licences = document.getElementById('licences');
  if (licences)
    root.append(
      element(
        'details',
        {},
        element('summary', {}, 'Licences of what draws this page'),
        element('pre', {}, licences.textContent ?? ''),
      ),
    );
  return root;
}
