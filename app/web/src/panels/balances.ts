// Energy balance (work of each row since the start) and momentum balance at the instant shown.
import { NUMERICAL, type Run } from '../protocol/run';
import type { RunRecord } from '../source/run_record';
import type { RunSource } from '../source/run_source';
import { definition, element, heading } from '../ui/dom';
import { numberCell, putNumber, row, table, wide } from '../ui/table';
import type { Panel } from './panel';
import type { Player } from '../source/playhead';

const DRAW = 60; // interval of updates [ms]
const DIGITS = 'Hover for full precision.';

// The largest first, the integration error last.
export function inOrder(works: [string, number][]): [string, number][] {
  const rank = (name: string) => (name === NUMERICAL ? 1 : 0);
  return [...works].sort(([a, x], [b, y]) => rank(a) - rank(b) || (Math.abs(y) || 0) - (Math.abs(x) || 0));
}

export class EnergyTable {
  readonly root: HTMLTableElement;
  private readonly cells: { now: HTMLElement; bar: HTMLElement }[];
  private readonly sum = numberCell(0);

  // `digits`: shown below the names.
  constructor(names: string[], head = 'work since the start', digits?: string[]) {
    this.cells = names.map(() => ({ now: numberCell(0), bar: element('i') }));
    const rows = this.cells.map(({ now, bar }, i) => {
      const below = digits ? [element('small', { 'data-row': names[i], title: 'at the end' }, digits[i])] : [];
      const term = names[i] === NUMERICAL ? 'residual' : names[i];
      const name = element('span', { title: definition(term) }, names[i]);
      return row([name, ...below], now, element('td.bar', bar));
    });
    const foot = row('total = change in kinetic energy', this.sum, element('td'));
    this.root = table([head, 'now [J]', ''], rows, { class: 'energy' }, foot);
  }

  show(works: number[], largest: number): void {
    works.forEach((work, i) => {
      const { now, bar } = this.cells[i];
      putNumber(now, work, largest);
      bar.className = work < 0 ? 'minus' : 'plus';
      bar.style.width = `${(50 * Math.abs(work)) / Math.max(largest, 1e-300)}%`;
    });
    putNumber(this.sum, works.reduce((sum, work) => sum + work, 0), largest);
  }
}

export class EnergyPanel implements Panel {
  readonly root = element('section.energy_balance');
  private readonly host = element('div');
  private table: EnergyTable | null = null;
  private record: RunRecord | null = null;
  private columns: number[] = [];
  private drawn = '';
  private drawnAt = -Infinity;

  constructor(private readonly source: RunSource) {
    const hint = 'Work of each force since the start. The rows sum to the change in kinetic energy; “numerical” ' +
      `is the residual, the error of the integrator. ${DIGITS}`;
    this.root.append(heading('Energy balance'), element('p.hint', hint), this.host);
    if (source.record) this.take(source.record);
  }

  draw(): void {
    const { record, at } = this.source;
    const now = performance.now();
    if (!record || record.store.length === 0 || now - this.drawnAt < DRAW) return;
    if (record !== this.record) this.take(record);
    const wanted = `${record.version} ${at}`;
    if (wanted === this.drawn) return;
    this.drawn = wanted;
    this.drawnAt = now;
    const { store, low, high } = record;
    const shown = Math.max(0, at === null ? store.length - 1 : store.after(at + 1e-9) - 1);
    const largest = Math.max(...this.columns.map((column) => Math.max(high[column], -low[column])));
    this.table!.show(this.columns.map((column) => store.value(column, shown)), largest);
  }

  // Rows of a live run keep their order; those of a recorded one are sorted by their final values.
  private take(record: RunRecord): void {
    this.record = record;
    const { store, scene, works } = record;
    const { isLive } = this.source;
    const end = (i: number) => store.value(works + i, store.length - 1);
    const rows = inOrder(scene.energy_balance.map((name, i) => [name, isLive ? 0 : end(i)]));
    this.columns = rows.map(([name]) => works + scene.energy_balance.indexOf(name));
    const names = rows.map(([name]) => name);
    this.table = isLive
      ? new EnergyTable(names)
      : new EnergyTable(names, 'work; below: at the end, all digits [J]', rows.map(([, work]) => String(work)));
    this.host.replaceChildren(this.table.root);
  }
}

export class MomentumPanel implements Panel {
  readonly root = element('section.momentum');
  private readonly cells: HTMLElement[][]; // the last row: the sum
  private readonly largest = [0, 0]; // [N s], [N m s]
  private shown = -1;

  constructor(private readonly run: Run, private readonly player: Player) {
    const { rows, values } = run.momentum;
    values.forEach((value, i) => {
      const half = i % 6 < 3 ? 0 : 1;
      this.largest[half] = Math.max(this.largest[half], Math.abs(value));
    });
    this.cells = [...rows, ''].map(() => Array.from({ length: 6 }, () => numberCell(0)));
    const lines = rows.map((name, i) => row(name, ...this.cells[i]));
    const foot = row('total = change in momentum', ...this.cells[rows.length]);
    const heads = ['', 'x', 'y', 'z [N s]', 'about x', 'y', 'z [N m s]'];
    const hint = `External impulse on all moving bodies since the start; about the world origin. ${DIGITS}`;
    this.root.hidden = rows.length === 0;
    this.root.append(
      heading('Momentum balance'),
      element('p.hint', hint),
      wide('momentum balance', table(heads, lines, {}, foot)),
    );
  }

  draw(): void {
    const { frame } = this.player;
    if (frame === this.shown) return;
    this.shown = frame;
    const { rows, values } = this.run.momentum;
    const sums = [0, 0, 0, 0, 0, 0];
    this.cells.forEach((cells, i) =>
      cells.forEach((cell, c) => {
        const value = i < rows.length ? values[6 * (frame * rows.length + i) + c] : sums[c];
        sums[c] += value;
        putNumber(cell, value, this.largest[c < 3 ? 0 : 1]);
      })
    );
  }
}
