// Panel of plots: charts, time window, export. Draws at most 30 times a second, and only visible charts.
import 'uplot/dist/uPlot.min.css';
import './plot.css';
import type { Panel } from '../panels/panel';
import type { RunRecord } from '../source/run_record';
import type { RunSource } from '../source/run_source';
import { button, element, icon, option } from '../ui/dom';
import { Chart } from './chart';
import type { Window } from './chart_data';
import { type CsvColumn, csvText, download, fileName } from './export';
import { type PlotSpec, PlotSpecs } from './specs';
import { Segments } from '../ui/choices';

const DRAW = 33; // [ms]
const SHARE = 5; // drawing takes at most this fraction of the time, 1/5
const REVIEW = 1000; // between updates of the list of curves [ms]
const LENGTHS: Record<string, number> = { '10 s': 10, '30 s': 30, all: Infinity };
const PAUSE = 'pause the plots while the run continues';

export class Plots implements Panel {
  readonly root = element('div.plots');
  degrees = true; // else radians
  private record: RunRecord | null = null;
  private readonly pause = button(icon('pause'), PAUSE, () => {
    this.zoom(this.window || !this.record ? null : this.shownWindow(this.record));
  });
  private length: number; // of the time shown [s]
  private readonly list = element('div');
  private readonly pick = element('select', { 'aria-label': 'any other quantity' });
  private readonly picked = element('div');
  private readonly watch = new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries)
      for (const chart of this.every) if (chart.root === target) chart.isSeen = isIntersecting;
    this.refresh();
  });
  private specs: PlotSpecs | null = null;
  private charts: Chart[] = [];
  private signature = '';
  private single: Chart | null = null;
  private window: Window | null = null; // zoomed or paused; null: the newest
  private drawnAt = 0;
  private pauseAfter = DRAW; // drawing
  private drawn = '';
  private marked: number | null = null;
  private reviewedAt = 0;

  constructor(readonly source: RunSource) {
    this.pick.addEventListener('change', () => this.choose(this.pick.value));
    this.length = LENGTHS[source.isLive ? '10 s' : 'all'];
    this.root.append(this.bar(), this.list, element('section.pick', this.pick, this.picked));
  }

  // Toolbar: time span and pause of a live run, unit of angles, export.
  private bar(): HTMLElement {
    const lengths = new Segments('time shown', Object.keys(LENGTHS), '10 s', (name) => {
      this.length = LENGTHS[name];
      this.zoom(null);
    });
    const angles = new Segments('angles in', ['°', 'rad'], '°', (name) => {
      this.degrees = name === '°';
      this.refresh();
    });
    const whole = button('whole run', 'show all of the run (double-click)', () => this.zoom(null));
    return element(
      'div.plot-bar',
      { role: 'toolbar', 'aria-label': 'plots' },
      ...(this.source.isLive ? [this.pause, lengths.root] : [whole]),
      angles.root,
      element('span.space'),
      button('all CSV', 'save all quantities as CSV', () => this.saveAll()),
    );
  }

  onTheme(): void {
    for (const chart of this.every) chart.remake();
    this.refresh();
  }

  draw(): void {
    const now = performance.now();
    const { source } = this;
    if (source.record !== this.record) this.take(source.record!);
    const { record } = this;
    if (!record || now - this.drawnAt < this.pauseAfter) return;
    if (now - this.reviewedAt > REVIEW) this.review();
    const window = this.shownWindow(record);
    const wanted = `${record.version} ${window.from} ${window.to}`;
    if (wanted === this.drawn && source.at === this.marked) return;
    this.drawnAt = now;
    this.marked = source.at;
    for (const chart of this.every) {
      if (!chart.isSeen) continue;
      if (wanted !== this.drawn) chart.draw(window, source.hasDiverged);
      chart.mark(source.at);
    }
    this.drawn = wanted;
    this.pauseAfter = Math.max(DRAW, SHARE * (performance.now() - now));
  }

  // All charts, visible or not.
  print(width: number): void {
    if (this.source.record !== this.record) this.take(this.source.record!);
    for (const chart of this.every) chart.draw(this.shownWindow(this.record!), false, width);
    this.refresh();
  }

  zoom(window: Window | null): void {
    this.window = window;
    const isPaused = window !== null;
    this.pause.setAttribute('aria-pressed', String(isPaused));
    this.pause.replaceChildren(icon(isPaused ? 'play' : 'pause'));
    this.pause.title = isPaused ? 'follow the run' : PAUSE;
    this.pause.setAttribute('aria-label', this.pause.title);
    this.refresh();
  }
  saveCsv(what: string, columns: CsvColumn[]): void {
    const { store, scene } = this.record!;
    const time = { name: 'time', unit: 's', value: (row: number) => store.times[row] };
    const text = csvText([time, ...columns], store.length);
    download(fileName(scene.title, what, 'csv'), new Blob([text], { type: 'text/csv' }));
  }

  // All channels and all rows of the energy balance.
  private saveAll(): void {
    if (!this.record) return;
    const { scene, store, works } = this.record;
    const value = (column: number) => (row: number) => store.value(column, row);
    const channels = scene.channels.map(({ name, unit }, i) => ({ name, unit, value: value(i) }));
    const rows = scene.energy_balance.map((name, i) => ({
      name: `energy_balance/${name}`,
      unit: 'J',
      value: value(works + i),
    }));
    this.saveCsv('all', [...channels, ...rows]);
  }

  private take(record: RunRecord): void {
    const isSame = record.scene.scene === this.record?.scene.scene;
    this.record = record;
    this.specs = new PlotSpecs(record, isSame ? this.specs?.colors : undefined);
    this.signature = '';
    if (!isSame) this.zoom(null);
    this.fillPick(record);
    this.review();
  }

  private get every(): Chart[] {
    return this.single ? [...this.charts, this.single] : this.charts;
  }

  private refresh(): void {
    this.drawn = '';
  }

  private shownWindow(record: RunRecord): Window {
    if (this.window) return this.window;
    const { store, before } = record;
    const [first, last] = store.length > 0 ? [store.first, store.last] : [0, 0];
    const newest = Math.max(last, before ? before.last : last);
    const { length } = this;
    if (length === Infinity) return { from: first, to: Math.max(newest, first + 1e-3) };
    const { at } = this.source;
    let to = Math.max(last, length);
    if (at !== null && at < to - length) to = at + 0.2 * length;
    return { from: to - length, to };
  }

  // Replaces charts whose curves have changed.
  private review(): void {
    this.reviewedAt = performance.now();
    const { record, specs } = this;
    if (!record || !specs) return;
    const all = specs.all(this.source.stepSize);
    const signature = JSON.stringify(all);
    if (signature === this.signature) return;
    this.signature = signature;
    const kept = new Map(this.charts.map((chart) => [JSON.stringify(chart.spec), chart]));
    const before = this.charts;
    this.charts = all.map((spec) => {
      const old = kept.get(JSON.stringify(spec));
      return old?.record === record ? old : this.chart(spec, record);
    });
    for (const chart of before) if (!this.charts.includes(chart)) this.end(chart);
    this.list.replaceChildren(...this.charts.map((chart) => chart.root));
    this.refresh();
  }

  private chart(spec: PlotSpec, record: RunRecord): Chart {
    const made = new Chart(spec, record, this);
    this.watch.observe(made.root);
    return made;
  }

  private end(chart: Chart): void {
    this.watch.unobserve(chart.root);
    chart.end();
  }

  private fillPick({ scene }: RunRecord): void {
    const others = scene.channels.map(({ name, unit }, i) => option(i, `${name} [${unit}]`));
    this.pick.replaceChildren(option('', 'any other quantity …'), ...others);
    this.choose('');
  }

  private choose(value: string): void {
    if (this.single) this.end(this.single);
    const spec = value === '' ? null : (this.specs?.single(Number(value)) ?? null);
    this.single = spec && this.record ? this.chart(spec, this.record) : null;
    this.picked.replaceChildren(...(this.single ? [this.single.root] : []));
    this.refresh();
  }
}
