// One plot, by uPlot: curves in a time window, legend with the values at one instant, marker, the previous
// branch dotted, and a limit line.
import uPlot from 'uplot';
import { axesOfTime, drawOver, Gestures } from './chart_parts';
import { button, definition, element, short } from '../ui/dom';
import { token } from '../ui/preferences';
import { branchCurves, type ChartExtras, colorOf, DASH, gapsOf, lines, lineSeries, rangeOf, stack, stackSeries, usualSize, type Window } from './chart_data';
import { fileName, savePicture } from './export';
import type { Plots } from './plots';
import { type Curve, type PlotSpec, screenUnit } from './specs';
import type { RunRecord } from '../source/run_record';
import { bucketsOf } from '../source/store';

const HEIGHT = 128;
const PICTURE = { width: 960, height: 420 };

export class Chart {
  readonly root: HTMLElement;
  isSeen = true; // in the visible part of the panel
  private readonly canvas = element('div.canvas', { role: 'img' });
  private readonly title = element('span');
  private readonly chips: { curve: Curve | null; chip: HTMLElement; value: HTMLElement }[] = [];
  private readonly hidden = new Set<Curve>();
  private chart: uPlot | null = null;
  private made = ''; // width and unit of the chart
  private extras: ChartExtras | null = null;
  private window: Window = { from: 0, to: 1 };
  private factor = 1;
  private size = 0; // of the largest value of the run, SI
  private unit = '';
  private at: number | null = null; // instant shown; null: the newest
  private readonly marker = element('div.marker');
  private readonly gestures: Gestures;

  constructor(readonly spec: PlotSpec, readonly record: RunRecord, private readonly plots: Plots) {
    const file = (kind: string, save: () => void) => {
      const made = button(kind, `save ${spec.title} as ${kind}`, save, 'small');
      made.setAttribute('aria-label', `${kind}: ${spec.title}`);
      return made;
    };
    const files = [file('CSV', () => this.saveCsv()), file('PNG', () => this.savePicture())];
    const name = element('span.name', { title: definition(spec.title) }, spec.title);
    const head = element('h3', name, this.title, element('span.space'), ...files);
    const legend = element('div.chips');
    for (const curve of spec.curves) legend.append(this.chip(curve, curve.name));
    if (spec.sum !== undefined) legend.append(this.chip(null, 'sum: change in kinetic energy'));
    if (spec.omitted > 0) legend.append(element('span.fine', `${spec.omitted} smaller not shown`));
    const names = spec.curves.map(({ name }) => name).join(', ');
    this.canvas.setAttribute('aria-label', `${spec.title} over time: ${names}`);
    this.root = element('section.plot', { id: `plot-${spec.id}` }, head, this.canvas, legend);
    this.gestures = new Gestures(this.canvas, () => this.chart, () => this.at, (time) => plots.source.look(time));
  }

  remake(): void {
    this.made = '';
  }

  // uPlot keeps charts with a common cursor alive until they are destroyed.
  end(): void {
    this.chart?.destroy();
    this.chart = null;
  }

  // `hasDiverged`: the range excludes the last values. `width`: for printing.
  draw(window: Window, hasDiverged: boolean, width = this.canvas.clientWidth): void {
    if (width < 60) return;
    this.window = window;
    const { store } = this.record;
    const begin = Math.max(0, store.after(window.from) - 1);
    const end = Math.min(store.length, store.after(window.to) + 1);
    const buckets = bucketsOf(begin, end, store.dropped, width / 1.5);
    this.scaleUnits();
    const { spec, shown, factor } = this;
    const { sum, limit, unit } = spec;
    const data = sum !== undefined ? stack(store, buckets, shown, sum) : lines(store, buckets, shown, factor);
    const sums = shown.filter((curve) => curve.color < 0 && end > 0);
    this.extras = {
      usual: hasDiverged ? usualSize(data.slice(1).flatMap((column) => [...column])) : Infinity,
      branch: branchCurves(this.record, window, spec, shown, factor),
      limit: limit && { ...limit, value: limit.value * factor },
      sums: sums.map(({ column }) => factor * store.value(column, end - 1)),
      isForce: unit === 'N',
    };
    const wanted = `${width} ${this.unit}`;
    if (this.made !== wanted || !this.chart) {
      this.make(width);
      this.made = wanted;
    }
    this.chart!.batch(() => {
      this.chart!.setData(data, false);
      this.chart!.setScale('x', { min: window.from, max: window.to });
    });
    this.mark(this.at);
  }

  mark(at: number | null): void {
    this.at = at;
    if (!this.chart) return;
    const left = at === null ? -1 : this.chart.valToPos(at, 'x');
    this.marker.hidden = left < 0 || left > this.chart.over.clientWidth;
    this.marker.style.transform = `translateX(${left}px)`;
    this.showValues();
  }

  // Values at the pointer, else at the instant shown, else the newest.
  private showValues(): void {
    const { store } = this.record;
    const left = this.chart?.cursor.left ?? -1;
    const time = left >= 0 ? this.chart!.posToVal(left, 'x') : this.at;
    const row = time === null ? store.length - 1 : store.after(time) - 1;
    for (const { curve, value } of this.chips)
      value.textContent = row < 0 ? '–' : short(this.factor * this.value(curve, row), this.factor * this.size);
  }

  // null: of the sum.
  private value(curve: Curve | null, row: number): number {
    const columns = curve ? [curve.column, ...(curve.rest ?? [])] : [this.spec.sum!];
    return columns.reduce((all, column) => all + this.record.store.value(column, row), 0);
  }

  private chip(curve: Curve | null, name: string): HTMLElement {
    const value = element('b');
    const attributes = { type: 'button', 'aria-pressed': 'true', class: curve?.style ?? 'line' };
    const chip = element('button', attributes, element('i'), element('span', name), value);
    if (curve)
      chip.addEventListener('click', () => {
        const hide = !this.hidden.has(curve);
        if (hide) this.hidden.add(curve);
        else this.hidden.delete(curve);
        chip.setAttribute('aria-pressed', String(!hide));
        this.remake();
      });
    this.chips.push({ curve, chip, value });
    return chip;
  }

  private scaleUnits(): void {
    const { low, high } = this.record;
    this.size = this.spec.curves.reduce((max, { column }) => Math.max(max, high[column], -low[column]), 0);
    const { unit, factor } = screenUnit(this.spec.unit, this.plots.degrees, this.size);
    this.factor = factor;
    if (unit === this.unit) return;
    this.unit = unit;
    this.title.textContent = ` [${unit}]`;
  }

  private get shown(): Curve[] {
    return this.spec.curves.filter((curve) => !this.hidden.has(curve));
  }

  private make(width: number): void {
    this.chart?.destroy();
    const options = this.options(width, HEIGHT);
    this.chart = new uPlot(options, [[], ...options.series.slice(1).map(() => [])], this.canvas);
    this.chart.over.append(this.marker);
    for (const { curve, chip } of this.chips)
      chip.style.setProperty('--curve', curve ? colorOf(curve) : token('--ink'));
  }

  private options(width: number, height: number): uPlot.Options {
    const isStack = this.spec.sum !== undefined;
    const { series, bands } = isStack ? stackSeries(this.shown) : lineSeries(this.shown);
    return {
      width,
      height,
      legend: { show: false },
      scales: { x: { time: false }, y: { range: (_, low, high) => rangeOf(low, high, this.extras!) } },
      padding: [8, 16, 0, 0],
      cursor: {
        y: false,
        points: { show: false },
        sync: { key: 'run', scales: ['x', null] },
        drag: { x: true, y: false, setScale: false, dist: 6 },
        bind: {
          mousedown: (_, __, handler) => (e) => (this.gestures.isHeld ? null : handler(e)),
          dblclick: () => () => {
            this.plots.zoom(null);
            return null;
          },
        },
      },
      axes: axesOfTime(this.unit),
      series: [{}, ...series.map((curve) => ({ ...curve, gaps: gapsOf(this.record) }))],
      bands,
      hooks: {
        setCursor: [() => this.showValues()],
        setSelect: [(chart) => this.select(chart)],
        draw: [(chart) => drawOver(chart, this.extras!)],
      },
    };
  }

  private select(chart: uPlot): void {
    const { left, width } = chart.select;
    if (width < 4) return;
    this.plots.zoom({ from: chart.posToVal(left, 'x'), to: chart.posToVal(left + width, 'x') });
    chart.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
  }

  private saveCsv(): void {
    const { id, unit } = this.spec;
    const columns = this.chips.map(({ curve }) => {
      const value = (row: number) => this.value(curve, row);
      return { name: curve?.name ?? 'sum', unit, value };
    });
    this.plots.saveCsv(id, columns);
  }

  // Drawn again, larger than on the page.
  private savePicture(): void {
    if (!this.chart) return;
    const host = element('div.unseen', { 'aria-hidden': 'true' });
    document.body.append(host);
    const options = this.options(PICTURE.width, PICTURE.height);
    const chart = new uPlot({ ...options, cursor: { show: false } }, [[]], host);
    chart.setData(this.chart.data, false);
    chart.setScale('x', { min: this.window.from, max: this.window.to });
    const lines = this.shown.map((curve) => {
      return { name: curve.name, color: colorOf(curve), dash: DASH[curve.style] ?? [] };
    });
    const title = `${this.spec.title} [${this.unit}]`;
    const name = fileName(this.record.scene.title, this.spec.id, 'png');
    // uPlot draws when this is done.
    setTimeout(() => {
      savePicture(name, title, chart.ctx.canvas, lines);
      chart.destroy();
      host.remove();
    });
  }
}
