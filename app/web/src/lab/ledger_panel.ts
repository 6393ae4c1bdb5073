// The energy ledger row by row, at the instant that is seen.
import { NUMERICAL } from '../data/run';
import { element, short } from '../ui/dom';
import type { Frame, SceneMessage } from './link';
import type { Panel } from './panel';

const DRAW = 100; // numbers that run faster cannot be read [ms]

export class LedgerPanel implements Panel {
  readonly root = element('section', { class: 'ledger' });
  private readonly body = element('tbody');
  private readonly sum = element('td', { class: 'number' });
  private cells: { now: HTMLTableCellElement; bar: HTMLElement }[] = [];
  private largest = 1e-300;
  private frame: Frame | null = null;
  private drawnAt = 0;
  private scene: SceneMessage | null = null;

  constructor() {
    const heads = ['work since the start', 'now [J]', ''];
    const head = element('tr', {}, ...heads.map((text) => element('th', { scope: 'col' }, text)));
    const name = element('th', { scope: 'row' }, 'their sum: rise of kinetic energy');
    const foot = element('tr', {}, name, this.sum);
    const hint =
      'Each row is the work that something has done. The rows add up to the rise of kinetic ' +
      'energy; “numerical” is what is left over, the integrator’s error. All digits stand at ' +
      'the pointer.';
    this.root.append(
      element('h3', {}, 'Energy'),
      element('p', { class: 'hint' }, hint),
      element('table', {}, element('thead', {}, head), this.body, element('tfoot', {}, foot)),
    );
  }

  onScene(scene: SceneMessage): void {
    this.scene = scene;
    this.largest = 1e-300;
    this.cells = [];
    const rows = scene.ledger.map((name, row) => ({ name, row }));
    rows.sort((a, b) => Number(a.name === NUMERICAL) - Number(b.name === NUMERICAL));
    const lines = rows.map(({ name, row }) => {
      const now = element('td', { class: 'number', 'data-row': name });
      const bar = element('i');
      this.cells[row] = { now, bar };
      const head = element('th', { scope: 'row' }, name);
      return element('tr', {}, head, now, element('td', { class: 'bar' }, bar));
    });
    this.body.replaceChildren(...lines);
  }

  onFrame(frame: Frame): void {
    if (frame.scene === this.scene?.scene) this.frame = frame;
  }

  draw(): void {
    const now = performance.now();
    const { frame } = this;
    if (!frame || now - this.drawnAt < DRAW) return;
    this.drawnAt = now;
    this.frame = null;
    for (const work of frame.works) this.largest = Math.max(this.largest, Math.abs(work));
    let sum = 0;
    this.cells.forEach(({ now, bar }, row) => {
      const work = frame.works[row];
      sum += work;
      put(now, work);
      bar.className = work < 0 ? 'minus' : 'plus';
      bar.style.width = `${(50 * Math.abs(work)) / this.largest}%`;
    });
    put(this.sum, sum);
  }
}

function put(cell: HTMLTableCellElement, value: number): void {
  cell.textContent = short(value);
  cell.title = String(value);
}
