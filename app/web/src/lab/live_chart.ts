// One plot of a run that goes on: uPlot over the rows that are in its window, a legend with the
// numbers of one instant, the branch that was left as dots, and a limit as a line.
import uPlot from 'uplot';
import { tickText, timeText } from '../plots/plot';
import { button, element, short } from '../ui/dom';
import { token } from '../ui/theme';
import { savePicture, type CsvColumn } from './export';
import { liveUnit, type LiveCurve, type LiveSpec } from './live_specs';
import type { RunRecord } from './run_record';
import { bucketsOf, outline, samples, timesOf, type Points, type Store } from './store';

const HEIGHT = 128;
const PALE = '80'; // opacity of what was left
const DASH: Record<LiveCurve['style'], number[] | undefined> = {
  line: undefined,
  dashed: [6, 4],
  dotted: [2, 4],
};

export interface Window {
  from: number;
  to: number;
}

export interface ChartUser {
  degrees: boolean;
  zoom(window: Window | null): void; // null: as it was
  look(time: number): void;
  saveCsv(what: string, columns: CsvColumn[]): void;
  pictureName(what: string): string;
}

interface Ghost {
  times: number[];
  values: Points;
  color: string;
}

export class LiveChart {
  readonly root: HTMLElement;
  isSeen = true; // within what is scrolled to
  private readonly canvas = element('div', { class: 'canvas' });
  private readonly title = element('span');
  private readonly chips: { curve: LiveCurve | null; chip: HTMLElement; value: HTMLElement }[] = [];
  private readonly hidden = new Set<LiveCurve>();
  private chart: uPlot | null = null;
  private made = ''; // what the chart was made for
  private ghosts: Ghost[] = [];
  private factor = 1;
  private unit = '';
  private at: number | null = null; // the instant that is looked at

  constructor(
    readonly spec: LiveSpec,
    readonly record: RunRecord,
    private readonly user: ChartUser,
  ) {
    const head = element(
      'h3',
      {},
      element('span', { class: 'name' }, spec.title),
      this.title,
      element('span', { class: 'space' }),
      button('CSV', `${spec.title}: numbers as a file`, () => this.saveCsv(), 'small'),
      button('PNG', `${spec.title}: picture as a file`, () => this.savePicture(), 'small'),
    );
    const legend = element('div', { class: 'chips' });
    for (const curve of spec.curves) legend.append(this.chip(curve, curve.name));
    if (spec.sum !== undefined) legend.append(this.chip(null, 'sum: rise of kinetic energy'));
    if (spec.omitted > 0)
      legend.append(element('span', { class: 'omitted' }, `${spec.omitted} smaller not shown`));
    this.root = element('section', { class: 'plot live', id: `live-${spec.id}` }, head);
    this.root.append(this.canvas, legend);
    this.scrub();
  }

  remake(): void {
    this.made = '';
  }

  // `at`: what is looked at, if not the newest.
  draw(window: Window, at: number | null): void {
    const width = this.canvas.clientWidth;
    if (width < 60) return;
    this.at = at;
    const { store } = this.record;
    const begin = Math.max(0, store.after(window.from) - 1);
    const end = Math.min(store.length, store.after(window.to) + 1);
    const buckets = bucketsOf(begin, end, store.dropped, width / 1.5);
    this.scaleUnits();
    const data = this.spec.sum === undefined ? this.lines(buckets) : this.stack(buckets);
    this.ghosts = this.ghostsOf(window);
    const wanted = `${width} ${this.unit}`;
    if (this.made !== wanted || !this.chart) {
      this.make(width);
      this.made = wanted;
    }
    this.chart!.batch(() => {
      this.chart!.setData(data, false);
      this.chart!.setScale('x', { min: window.from, max: window.to });
    });
    this.tell();
  }

  // The numbers under the pointer, else of what is looked at, else the newest.
  private tell(): void {
    const { store } = this.record;
    const left = this.chart?.cursor.left ?? -1;
    const time = left >= 0 ? this.chart!.posToVal(left, 'x') : this.at;
    const row = time === null ? store.length - 1 : store.after(time) - 1;
    for (const { curve, value } of this.chips) {
      const column = curve ? curve.column : this.spec.sum!;
      value.textContent = row < 0 ? '–' : short(this.factor * store.value(column, row));
    }
  }

  private chip(curve: LiveCurve | null, name: string): HTMLElement {
    const value = element('b');
    const chip = element(
      'button',
      { type: 'button', 'aria-pressed': 'true', class: curve?.style ?? 'line' },
      element('i'),
      element('span', {}, name),
      value,
    );
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
    const size = this.spec.curves.reduce(
      (most, { column }) => Math.max(most, high[column], -low[column]),
      0,
    );
    const { unit, factor } = liveUnit(this.spec.unit, this.user.degrees, size);
    this.factor = factor;
    if (unit === this.unit) return;
    this.unit = unit;
    this.title.textContent = ` [${unit}]`;
  }

  private get shown(): LiveCurve[] {
    return this.spec.curves.filter((curve) => !this.hidden.has(curve));
  }

  private scaled(values: Points): Points {
    if (this.factor === 1) return values;
    return values.map((value) => (value === null ? null : value * this.factor));
  }

  private lines(buckets: ReturnType<typeof bucketsOf>): uPlot.AlignedData {
    const { store } = this.record;
    const curves = this.shown.map((curve) =>
      this.scaled(outline(store.column(curve.column), buckets)),
    );
    return [timesOf(store.times, buckets, true), ...curves];
  }

  // What is positive piles up above zero, what is negative below; their sum is the line.
  private stack(buckets: ReturnType<typeof bucketsOf>): uPlot.AlignedData {
    const { store } = this.record;
    const times = timesOf(store.times, buckets, false);
    const data: uPlot.AlignedData = [times];
    const parts = this.shown.map((curve) => samples(store.column(curve.column), buckets));
    for (const sign of [1, -1]) {
      let edge: number[] = times.map(() => 0);
      data.push(edge);
      for (const part of parts) {
        edge = edge.map((y, i) => y + sign * Math.max(0, sign * (part[i] ?? 0)));
        data.push(edge);
      }
    }
    data.push(samples(store.column(this.spec.sum!), buckets));
    return data;
  }

  private ghostsOf(window: Window): Ghost[] {
    const { before } = this.record;
    if (!before || before.length === 0) return [];
    const begin = Math.max(0, before.after(window.from) - 1);
    const end = Math.min(before.length, before.after(window.to) + 1);
    const buckets = bucketsOf(begin, end, 0, 400);
    const times = timesOf(before.times, buckets, true);
    const of = (store: Store, column: number) =>
      this.scaled(outline(store.column(column), buckets));
    if (this.spec.sum !== undefined)
      return [{ times, values: of(before, this.spec.sum), color: token('--ink') }];
    return this.shown
      .filter((curve) => curve.color >= 0)
      .map((curve) => ({ times, values: of(before, curve.column), color: colorOf(curve) }));
  }

  // Anew, in the colours of the theme.
  private make(width: number): void {
    this.chart?.destroy();
    const { series, bands } = this.spec.sum === undefined ? this.lineSeries() : this.stackSeries();
    const grid = { stroke: token('--grid'), width: 1 };
    const font = '11px system-ui, sans-serif';
    const axis = { stroke: token('--muted'), grid, ticks: { show: false }, font };
    const options: uPlot.Options = {
      width,
      height: HEIGHT,
      legend: { show: false },
      scales: {
        x: { time: false },
        y: { range: (_, low, high) => this.range(low, high) },
      },
      padding: [8, 10, 0, 0],
      cursor: {
        y: false,
        points: { show: false },
        sync: { key: 'lab', scales: ['x', null] },
        drag: { x: true, y: false, setScale: false, dist: 6 },
        bind: {
          mousedown: (_, __, handler) => (e) => (e.shiftKey ? null : handler(e)),
          dblclick: () => () => {
            this.user.zoom(null);
            return null;
          },
        },
      },
      axes: [
        { ...axis, size: 24, gap: 2, values: (_, ticks) => ticks.map(timeText) },
        { ...axis, size: 52, gap: 4, values: (_, ticks) => ticks.map(tickText) },
      ],
      series: [{}, ...series],
      bands,
      hooks: {
        setCursor: [() => this.tell()],
        setSelect: [(chart) => this.select(chart)],
        draw: [(chart) => this.drawOver(chart)],
      },
    };
    this.chart = new uPlot(options, [[], ...series.map(() => [])], this.canvas);
    for (const { curve, chip } of this.chips)
      chip.style.setProperty('--curve', curve ? colorOf(curve) : token('--ink'));
  }

  private lineSeries() {
    const series = this.shown.map((curve) => ({
      stroke: colorOf(curve),
      width: curve.style === 'line' ? 1.75 : 1.5,
      dash: DASH[curve.style],
      points: { show: false },
    }));
    return { series, bands: [] as uPlot.Band[] };
  }

  private stackSeries() {
    const series: uPlot.Series[] = [];
    const bands: uPlot.Band[] = [];
    for (const sign of [1, -1]) {
      series.push({ stroke: 'transparent', points: { show: false } });
      for (const curve of this.shown) {
        series.push({ stroke: colorOf(curve), width: 0.75, points: { show: false } });
        const at = series.length;
        const pair: [number, number] = sign > 0 ? [at, at - 1] : [at - 1, at];
        bands.push({ series: pair, fill: `${colorOf(curve)}8c` });
      }
    }
    series.push({ stroke: token('--ink'), width: 1.75, points: { show: false } });
    return { series, bands };
  }

  private range(low: number | null, high: number | null): [number, number] {
    let a = low ?? 0;
    let b = high ?? 0;
    for (const { values } of this.ghosts)
      for (const value of values) {
        if (value === null) continue;
        a = Math.min(a, value);
        b = Math.max(b, value);
      }
    const { limit } = this.spec;
    if (limit && (limit.always || b > 0.3 * limit.value * this.factor)) {
      b = Math.max(b, limit.value * this.factor);
      a = Math.min(a, 0);
    }
    if (a === b) return a === 0 ? [-1, 1] : [a - 0.1 * Math.abs(a), b + 0.1 * Math.abs(b)];
    const [from, to] = uPlot.rangeNum(a, b, 0.08, true);
    return [from ?? a, to ?? b];
  }

  private select(chart: uPlot): void {
    const { left, width } = chart.select;
    if (width < 4) return;
    this.user.zoom({
      from: chart.posToVal(left, 'x'),
      to: chart.posToVal(left + width, 'x'),
    });
    chart.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
  }

  private drawOver(chart: uPlot): void {
    const { ctx, bbox } = chart;
    const px = devicePixelRatio;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    ctx.lineWidth = 1.75 * px;
    ctx.setLineDash([1.5 * px, 3.5 * px]);
    for (const ghost of this.ghosts) {
      ctx.strokeStyle = ghost.color + PALE;
      strokeLine(chart, ghost);
    }
    this.drawLimit(chart, px);
    if (this.at !== null) {
      ctx.setLineDash([]);
      ctx.strokeStyle = token('--accent');
      const x = chart.valToPos(this.at, 'x', true);
      stroke(ctx, [x, bbox.top], [x, bbox.top + bbox.height]);
    }
    ctx.restore();
  }

  private drawLimit(chart: uPlot, px: number): void {
    const { limit } = this.spec;
    if (!limit) return;
    const { ctx, bbox } = chart;
    const y = chart.valToPos(limit.value * this.factor, 'y', true);
    ctx.strokeStyle = ctx.fillStyle = token('--beyond');
    ctx.lineWidth = px;
    ctx.setLineDash([8 * px, 3 * px]);
    stroke(ctx, [bbox.left, y], [bbox.left + bbox.width, y]);
    ctx.font = `${11 * px}px system-ui, sans-serif`;
    ctx.textAlign = 'left';
    ctx.textBaseline = 'top';
    ctx.fillText(limit.words, bbox.left + 6 * px, y + 3 * px);
  }

  // Drag with shift: back to that instant.
  private scrub(): void {
    let scrubbing = false;
    const seek = (event: PointerEvent) => {
      if (!this.chart) return;
      const left = this.chart.over.getBoundingClientRect().left;
      this.user.look(this.chart.posToVal(event.clientX - left, 'x'));
    };
    this.canvas.addEventListener('pointerdown', (event) => {
      if (!event.shiftKey || event.button !== 0) return;
      scrubbing = true;
      this.canvas.setPointerCapture(event.pointerId);
      seek(event);
    });
    this.canvas.addEventListener('pointermove', (event) => scrubbing && seek(event));
    this.canvas.addEventListener('pointerup', () => (scrubbing = false));
  }

  private saveCsv(): void {
    const { store } = this.record;
    const columns = this.spec.curves.map(({ column, name }) => ({
      name,
      unit: this.spec.unit,
      value: (row: number) => store.value(column, row),
    }));
    const { sum } = this.spec;
    if (sum !== undefined)
      columns.push({ name: 'sum', unit: 'J', value: (row) => store.value(sum, row) });
    this.user.saveCsv(this.spec.id, columns);
  }

  private savePicture(): void {
    if (!this.chart) return;
    const lines = this.shown.map((curve) => ({
      name: curve.name,
      color: colorOf(curve),
      dashed: curve.style !== 'line',
    }));
    const title = `${this.spec.title} [${this.unit}]`;
    const name = this.user.pictureName(this.spec.id);
    const canvas = this.chart.ctx.canvas;
    savePicture(name, title, canvas, lines, token('--surface'), token('--ink'));
  }
}

function stroke(ctx: CanvasRenderingContext2D, a: [number, number], b: [number, number]): void {
  ctx.beginPath();
  ctx.moveTo(...a);
  ctx.lineTo(...b);
  ctx.stroke();
}

function strokeLine(chart: uPlot, { times, values }: Ghost): void {
  const { ctx } = chart;
  ctx.beginPath();
  let isDown = false;
  values.forEach((value, i) => {
    if (value !== null) {
      const x = chart.valToPos(times[i], 'x', true);
      const y = chart.valToPos(value, 'y', true);
      if (isDown) ctx.lineTo(x, y);
      else ctx.moveTo(x, y);
    }
    isDown = value !== null;
  });
  ctx.stroke();
}

function colorOf(curve: LiveCurve): string {
  return token(curve.color < 0 ? '--ink' : `--c${curve.color % 8}`);
}
