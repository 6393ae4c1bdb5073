// The momentum balance: what acted from outside, and its moment about the origin.
import type { Run } from '../protocol/run';
import type { Player } from '../source/player';
import { element } from '../ui/dom';
import { numberCell, putNumber, row, table } from '../ui/table';
import type { Panel } from './panel';

export class MomentumPanel implements Panel {
  readonly root = element('section.momentum');
  private readonly cells: HTMLElement[][]; // the last: their sum
  private shown = -1;

  constructor(private readonly run: Run, private readonly player: Player) {
    const { rows } = run.momentum;
    this.cells = [...rows, ''].map(() => Array.from({ length: 6 }, () => numberCell(0)));
    const lines = rows.map((name, i) => row(name, ...this.cells[i]));
    const foot = row('their sum: change of momentum', ...this.cells[rows.length]);
    const heads = ['', 'x', 'y', 'z [N s]', 'about x', 'y', 'z [N m s]'];
    const hint =
      'What acted from outside on all that forces move, up to the time shown; the moments are ' +
      'about the world’s origin. All digits stand at the pointer.';
    this.root.hidden = rows.length === 0;
    this.root.append(
      element('h3', 'Momentum'),
      element('p.hint', hint),
      element('div.wide', table(heads, lines, {}, foot)),
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
        putNumber(cell, value);
      }),
    );
  }
}
