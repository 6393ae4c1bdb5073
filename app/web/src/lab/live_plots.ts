// The plots' panel: which charts, over which time, and their files. Draws at most thirty times a
// second, and only what is seen.
import { element } from '../ui/dom';
import { fileName, saveCsv, type CsvColumn } from './export';
import type { Frame, SceneMessage, StateMessage } from './link';
import type { Window } from './chart_data';
import { LiveChart, type ChartUser } from './live_chart';
import { LiveSpecs, type LiveSpec } from './live_specs';
import type { LabPage, Panel } from './panel';
import { PlotBar } from './plot_bar';
import { decodeHistory, RunRecord } from './run_record';

const DRAW = 33; // [ms]
const SHARE = 5; // where drawing is slow, it takes one in so many milliseconds
const REVIEW = 1000; // how often it is asked which curves there are [ms]
const REFILL = 3000; // how often missed frames are asked for [ms]

export class LivePlots implements Panel, ChartUser {
  readonly root = element('div', { class: 'live-plots' });
  degrees = true;
  record: RunRecord | null = null;
  private readonly bar: PlotBar;
  private readonly list = element('div');
  private readonly pick = element('select', { 'aria-label': 'any other quantity' });
  private readonly picked = element('div');
  private readonly watch: IntersectionObserver;
  private specs: LiveSpecs | null = null;
  private charts: LiveChart[] = [];
  private signature = '';
  private single: LiveChart | null = null;
  private window: Window | null = null; // zoomed; null: the newest
  private drawnAt = 0;
  private pauseAfter = DRAW; // a picture
  private drawn = '';
  private reviewedAt = 0;
  private askedAt = -Infinity;
  private asking = false;

  constructor(private readonly page: LabPage) {
    this.bar = new PlotBar({
      paused: (on) => this.pause(on),
      all: () => this.zoom(null),
      degrees: (on) => {
        this.degrees = on;
        this.refresh();
      },
      saveCsv: () => this.saveAll(),
    });
    this.pick.addEventListener('change', () => this.choose(this.pick.value));
    const pick = element('section', { class: 'pick' }, this.pick, this.picked);
    this.root.append(this.bar.root, this.list, pick);
    this.watch = new IntersectionObserver((entries) => {
      for (const { target, isIntersecting } of entries)
        for (const chart of this.every) if (chart.root === target) chart.isSeen = isIntersecting;
      this.refresh();
    });
    // Hidden pages get no pictures, and so no frames.
    document.addEventListener('visibilitychange', () => this.fill());
  }

  onScene(scene: SceneMessage): void {
    const old = this.record?.scene;
    const isSame = old?.scene === scene.scene;
    const names = (of: SceneMessage) => JSON.stringify([of.channels, of.ledger]);
    if (!isSame || names(old) !== names(scene)) {
      this.record = isSame ? this.record!.grownTo(scene) : new RunRecord(scene);
      this.specs = new LiveSpecs(this.record, isSame ? this.specs?.colors : undefined);
      this.signature = '';
      if (!isSame) this.zoom(null);
      this.fillPick(scene);
      this.review();
    }
    // A connection that was lost has missed frames too.
    this.record!.lost = isSame ? (this.record!.lost ?? this.record!.store.last) : -Infinity;
    this.askedAt = -Infinity;
  }

  onState(state: StateMessage): void {
    this.record?.onState(state);
  }

  onFrame(frame: Frame): void {
    this.record?.addFrame(frame);
    this.fill();
  }

  onTheme(): void {
    for (const chart of this.every) chart.remake();
    this.refresh();
  }

  draw(): void {
    const now = performance.now();
    const { record } = this;
    if (!record || now - this.drawnAt < this.pauseAfter) return;
    if (now - this.reviewedAt > REVIEW) this.review();
    const window = this.shownWindow(record);
    const at = this.page.state?.at ?? null;
    const isBlown = (this.page.state?.dead ?? null) !== null;
    const wanted = `${record.version} ${window.from} ${window.to} ${at}`;
    if (wanted === this.drawn) return;
    this.drawn = wanted;
    this.drawnAt = now;
    for (const chart of this.every) if (chart.isSeen) chart.draw(window, at, isBlown);
    this.pauseAfter = Math.max(DRAW, SHARE * (performance.now() - now));
  }

  // Of a chart.
  zoom(window: Window | null): void {
    this.window = window;
    this.bar.showPaused(window !== null);
    this.refresh();
  }
  look(time: number): void {
    this.page.send({ do: 'look', at: time });
  }
  saveCsv(what: string, columns: CsvColumn[]): void {
    const store = this.record!.store;
    const time = { name: 'time', unit: 's', value: (row: number) => store.times[row] };
    saveCsv(fileName(this.record!.scene.title, what, 'csv'), [time, ...columns], store.length);
  }
  pictureName(what: string): string {
    return fileName(this.record!.scene.title, what, 'png');
  }

  // Every channel and every row of the ledger.
  saveAll(): void {
    if (!this.record) return;
    const { scene, store, works } = this.record;
    const value = (column: number) => (row: number) => store.value(column, row);
    const channels = scene.channels.map(({ name, unit }, i) => ({ name, unit, value: value(i) }));
    const rows = scene.ledger.map((name, i) => ({
      name: `ledger/${name}`,
      unit: 'J',
      value: value(works + i),
    }));
    this.saveCsv('all', [...channels, ...rows]);
  }

  private get every(): LiveChart[] {
    return this.single ? [...this.charts, this.single] : this.charts;
  }

  private refresh(): void {
    this.drawn = '';
  }

  private pause(on: boolean): void {
    this.window = on && this.record ? this.shownWindow(this.record) : null;
    this.refresh();
  }

  private shownWindow(record: RunRecord): Window {
    if (this.window) return this.window;
    const { store } = record;
    const first = store.length > 0 ? store.first : 0;
    const last = store.length > 0 ? store.last : 0;
    const newest = Math.max(last, record.before ? record.before.last : last);
    const { length } = this.bar;
    if (length === Infinity) return { from: first, to: Math.max(newest, first + 1e-3) };
    const at = this.page.state?.at ?? null;
    let to = Math.max(last, length);
    if (at !== null && at < to - length) to = at + 0.2 * length;
    return { from: to - length, to };
  }

  // Charts anew where their curves have changed.
  private review(): void {
    this.reviewedAt = performance.now();
    const { record, specs } = this;
    if (!record || !specs) return;
    const all = specs.all(this.page.state?.step ?? 1e-3);
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

  private chart(spec: LiveSpec, record: RunRecord): LiveChart {
    const made = new LiveChart(spec, record, this);
    this.watch.observe(made.root);
    return made;
  }

  private end(chart: LiveChart): void {
    this.watch.unobserve(chart.root);
    chart.end();
  }

  private fillPick(scene: SceneMessage): void {
    this.pick.replaceChildren(element('option', { value: '' }, 'any other quantity …'));
    scene.channels.forEach(({ name, unit }, i) =>
      this.pick.append(element('option', { value: String(i) }, `${name} [${unit}]`)),
    );
    this.choose('');
  }

  private choose(value: string): void {
    if (this.single) this.end(this.single);
    const spec = value === '' ? null : (this.specs?.single(Number(value)) ?? null);
    this.single = spec && this.record ? this.chart(spec, this.record) : null;
    this.picked.replaceChildren(...(this.single ? [this.single.root] : []));
    this.refresh();
  }

  // What the page did not see, from the lab's memory.
  private fill(): void {
    const { record } = this;
    const now = performance.now();
    if (!record || record.lost === null || this.asking || now - this.askedAt < REFILL) return;
    this.asking = true;
    this.askedAt = now;
    void this.ask(record, record.lost).finally(() => (this.asking = false));
  }

  private async ask(record: RunRecord, lost: number): Promise<void> {
    const { epoch } = record;
    record.lost = null;
    const from = Number.isFinite(lost) ? lost : 0;
    try {
      const answer = await fetch(`/history?from=${from}`);
      const history = answer.ok ? decodeHistory(await answer.arrayBuffer()) : null;
      if (history && epoch === record.epoch) record.addHistory(history);
    } catch {
      record.lost = Math.min(lost, record.lost ?? Infinity); // no connection: later
    }
  }
}
