// One plot: uPlot, a legend that is buttons, and a line at the time shown.
import uPlot from 'uplot';
import { element, short } from '../ui/dom';
import type { Player } from '../ui/player';
import { token } from '../ui/theme';
import { axesOfTime } from './axes';
import type { Curve, PanelSpec } from './panels';

const HEIGHT = 132;
const SYNC = 'run';

interface Chip {
  curve: Curve | null; // null: the sum
  root: HTMLButtonElement;
  value: HTMLElement;
}

export class Plot {
  readonly root: HTMLElement;
  private readonly canvas = element('div', { class: 'canvas' });
  private readonly chips: Chip[] = [];
  private readonly hidden = new Set<Curve>();
  private readonly playhead = element('div', { class: 'playhead' });
  private chart: uPlot | null = null;
  private hovered: number | null = null;

  constructor(
    private readonly spec: PanelSpec,
    private readonly player: Player,
  ) {
    const legend = element('div', { class: 'chips' });
    for (const curve of spec.curves) legend.append(this.chip(curve, curve.name));
    if (spec.stacked) legend.append(this.chip(null, spec.stacked.name));
    if (spec.omitted)
      legend.append(element('span', { class: 'omitted' }, `${spec.omitted} more below`));
    const title = element('h3', {}, spec.title, element('span', {}, ` [${spec.unit}]`));
    this.root = element('section', { class: 'plot', id: `plot-${spec.id}` }, title);
    this.root.append(this.canvas, legend);
    new ResizeObserver(() => this.fit()).observe(this.canvas);
    this.scrub();
  }

  // Anew, in the colours of the theme.
  draw(): void {
    this.chart?.destroy();
    const { series, bands, data } = this.spec.stacked ? this.stack() : this.lines();
    const options: uPlot.Options = {
      width: Math.max(120, this.canvas.clientWidth),
      height: HEIGHT,
      legend: { show: false },
      scales: { x: { time: false } },
      padding: [8, 16, 0, 0],
      cursor: {
        y: false,
        points: { show: false },
        sync: { key: SYNC },
        drag: { x: true, y: false, setScale: true },
        bind: { mousedown: (_, __, handler) => (e) => (e.shiftKey ? handler(e) : null) },
      },
      axes: axesOfTime(),
      series: [{}, ...series],
      bands,
      hooks: {
        setCursor: [(chart) => this.hover(chart.cursor.idx ?? null)],
        setScale: [() => this.move()],
      },
    };
    this.chart = new uPlot(options, data, this.canvas);
    this.chart.over.append(this.playhead);
    this.colorChips();
    this.move();
  }

  // The line, and the numbers of that time.
  move(): void {
    if (!this.chart) return;
    const at = this.chart.valToPos(this.player.time, 'x');
    const inside = at >= 0 && at <= this.chart.over.clientWidth;
    this.playhead.style.display = inside ? '' : 'none';
    this.playhead.style.transform = `translateX(${at}px)`;
    if (this.hovered === null) this.tell(this.player.frame);
  }

  private chip(curve: Curve | null, name: string): HTMLElement {
    const value = element('b');
    const root = element(
      'button',
      { type: 'button', 'aria-pressed': 'true', class: curve?.dashed ? 'dashed' : '' },
      element('i'),
      element('span', {}, name),
      value,
    );
    if (curve) root.addEventListener('click', () => this.toggle(curve, root));
    this.chips.push({ curve, root, value });
    return root;
  }

  private toggle(curve: Curve, chip: HTMLElement): void {
    const hide = !this.hidden.has(curve);
    if (hide) this.hidden.add(curve);
    else this.hidden.delete(curve);
    chip.setAttribute('aria-pressed', String(!hide));
    this.draw();
  }

  private colorChips(): void {
    for (const { curve, root } of this.chips)
      root.style.setProperty('--curve', curve ? colorOf(curve) : token('--ink'));
  }

  private hover(frame: number | null): void {
    this.hovered = frame;
    this.tell(frame ?? this.player.frame);
  }

  private tell(frame: number): void {
    for (const { curve, value } of this.chips) {
      const values = curve ? curve.values : this.spec.stacked!.total;
      value.textContent = short(values[frame]);
    }
  }

  // To the width of its place, or to that of a page, where a hidden one is seen too.
  fit(width = this.canvas.clientWidth): void {
    if (this.chart && width > 0 && width !== this.chart.width)
      this.chart.setSize({ width, height: HEIGHT });
    this.move();
  }

  private scrub(): void {
    let scrubbing = false;
    const seek = (event: PointerEvent) => {
      if (!this.chart) return;
      const left = this.chart.over.getBoundingClientRect().left;
      this.player.seek(this.chart.posToVal(event.clientX - left, 'x'));
    };
    this.canvas.addEventListener('pointerdown', (event) => {
      if (event.shiftKey || event.button !== 0) return;
      scrubbing = true;
      this.player.playing = false;
      this.canvas.setPointerCapture(event.pointerId);
      seek(event);
    });
    this.canvas.addEventListener('pointermove', (event) => scrubbing && seek(event));
    this.canvas.addEventListener('pointerup', () => (scrubbing = false));
  }

  private lines() {
    const series = this.spec.curves.map((curve) => ({
      stroke: colorOf(curve),
      width: curve.dashed ? 1.5 : 1.75,
      dash: curve.dashed ? [5, 4] : undefined,
      show: !this.hidden.has(curve),
      points: { show: false },
    }));
    const data = [this.player.times, ...this.spec.curves.map((curve) => curve.values)];
    return { series, bands: [] as uPlot.Band[], data: data as uPlot.AlignedData };
  }

  // What is positive piles up above zero, what is negative below; their sum is the line.
  private stack() {
    const times = this.player.times;
    const series: uPlot.Series[] = [];
    const bands: uPlot.Band[] = [];
    const data: Float64Array[] = [times];
    for (const sign of [1, -1]) {
      let edge = new Float64Array(times.length);
      data.push(edge);
      series.push({ stroke: 'transparent', points: { show: false } });
      for (const curve of this.spec.curves) {
        if (this.hidden.has(curve)) continue;
        edge = edge.map((y, i) => y + sign * Math.max(0, sign * curve.values[i]));
        data.push(edge);
        const at = data.length - 1;
        series.push({ stroke: colorOf(curve), width: 0.75, points: { show: false } });
        const pair: [number, number] = sign > 0 ? [at, at - 1] : [at - 1, at];
        bands.push({ series: pair, fill: `${colorOf(curve)}8c` });
      }
    }
    data.push(this.spec.stacked!.total);
    series.push({ stroke: token('--ink'), width: 1.75, points: { show: false } });
    return { series, bands, data: data as unknown as uPlot.AlignedData };
  }
}

function colorOf(curve: Curve): string {
  return token(`--c${curve.color % 8}`);
}
