// Axes of a chart, previous branch and limit, pointer gestures.
import type uPlot from 'uplot';
import { token } from '../ui/preferences';
import type { ChartExtras, BranchCurve } from './chart_data';
import type { PlotSpec } from './specs';

const SPACE = 24; // between ticks of the y axis [pixels]
const DEGREES = [0.1, 0.5, 1, 2, 5, 10, 15, 30, 45, 90, 180, 360, 720, 1800, 3600, 36000];

// `unit`: of the y axis.
export function axesOfTime(unit: string): uPlot.Axis[] {
  const grid = { stroke: token('--grid'), width: 1 };
  const font = '11px system-ui, sans-serif';
  const axis = { stroke: token('--muted'), grid, ticks: { show: false }, font };
  return [
    { ...axis, size: 24, gap: 2, values: (_, ticks) => ticks.map((time) => `${+time.toPrecision(6)} s`) },
    {
      ...axis,
      size: 52,
      gap: 4,
      space: SPACE,
      ...(unit === '°' ? { incrs: DEGREES } : {}),
      values: (_, ticks, __, ___, interval) => ticks.map((tick) => tickText(tick, interval)),
    },
  ];
}

// With as many digits as tell the value from its neighbours, one `interval` away.
export function tickText(value: number, interval: number): string {
  const size = Math.abs(value);
  if (size < interval / 2) return '0';
  const digit = Math.floor(Math.log10(interval) + 1e-9); // of the last one that differs
  const lead = interval / 10 ** digit;
  const decimals = Math.abs(lead - Math.round(lead)) > 1e-6 ? 1 - digit : -digit; // 2.5 has one more
  const isFar = size >= 1e5 || interval < 1e-4;
  const significant = Math.max(0, Math.floor(Math.log10(size) + 1e-9) + decimals);
  const text = isFar ? value.toExponential(Math.min(significant, 20)) : value.toFixed(Math.max(0, decimals));
  return text.replaceAll('-', '−');
}

const PALE = '90'; // opacity of the previous branch

// The previous branch and the limit. Pixels of the canvas.
export function drawOver(chart: uPlot, { branch, limit }: ChartExtras): void {
  const { ctx, bbox } = chart;
  const px = devicePixelRatio;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.lineWidth = 1.75 * px;
  ctx.setLineDash([1.5 * px, 3.5 * px]);
  for (const curve of branch) {
    ctx.strokeStyle = curve.color + PALE;
    strokeBranch(chart, curve);
  }
  if (limit) drawLimit(chart, limit, px);
  ctx.restore();
}

function drawLimit(chart: uPlot, limit: NonNullable<PlotSpec['limit']>, px: number): void {
  const { ctx, bbox } = chart;
  const y = chart.valToPos(limit.value, 'y', true);
  ctx.strokeStyle = ctx.fillStyle = token('--beyond');
  ctx.lineWidth = px;
  ctx.setLineDash([8 * px, 3 * px]);
  ctx.stroke(new Path2D(`M${bbox.left} ${y}h${bbox.width}`));
  ctx.font = `${11 * px}px system-ui, sans-serif`;
  ctx.textAlign = 'left';
  ctx.textBaseline = 'top';
  ctx.fillText(limit.words, bbox.left + 6 * px, y + 3 * px);
}

function strokeBranch(chart: uPlot, { times, values }: BranchCurve): void {
  const path = new Path2D();
  values.forEach((value, i) => {
    if (value === null) return;
    const [x, y] = [chart.valToPos(times[i], 'x', true), chart.valToPos(value, 'y', true)];
    if (i > 0 && values[i - 1] !== null) path.lineTo(x, y);
    else path.moveTo(x, y);
  });
  chart.ctx.stroke(path);
}

const NEAR = 7; // pixels from the marker
const MOVED = 5; // pixels from a click to a drag
const DOUBLE = 250; // interval of a double click [ms]

// A click seeks, as does dragging the marker. uPlot handles the others: drag to zoom, double-click to reset.
export class Gestures {
  isHeld = false; // the marker

  constructor(
    canvas: HTMLElement,
    chart: () => uPlot | null,
    marker: () => number | null, // its time
    seek: (time: number) => void,
  ) {
    let from = 0; // x of pointerdown
    let click = 0;
    const seekAt = ({ clientX }: MouseEvent) => {
      const plot = chart();
      if (plot) seek(plot.posToVal(clientX - plot.over.getBoundingClientRect().left, 'x'));
    };
    canvas.addEventListener('pointerdown', (event) => {
      const plot = chart();
      const at = marker();
      from = event.clientX;
      if (!plot || event.button !== 0 || at === null) return;
      const place = plot.over.getBoundingClientRect().left + plot.valToPos(at, 'x');
      this.isHeld = Math.abs(from - place) < NEAR;
      if (this.isHeld) canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener('pointermove', (event) => this.isHeld && seekAt(event));
    for (const end of ['pointerup', 'pointercancel'] as const)
      canvas.addEventListener(end, () => (this.isHeld = false));
    canvas.addEventListener('click', (event) => {
      clearTimeout(click);
      if (event.detail > 1 || Math.abs(event.clientX - from) > MOVED) return;
      click = setTimeout(() => seekAt(event), DOUBLE);
    });
  }
}
