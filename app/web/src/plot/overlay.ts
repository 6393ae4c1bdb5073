// What stands over the curves of a plot: the branch that was left, the limit. Pixels of the canvas.
import type uPlot from 'uplot';
import { token } from '../ui/theme';
import type { Ghost } from './chart_data';
import type { PlotSpec } from './specs';

const PALE = '90'; // opacity of what was left

type Point = [number, number];

export function drawOver(chart: uPlot, ghosts: Ghost[], limit: PlotSpec['limit']): void {
  const { ctx, bbox } = chart;
  const px = devicePixelRatio;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.lineWidth = 1.75 * px;
  ctx.setLineDash([1.5 * px, 3.5 * px]);
  for (const ghost of ghosts) {
    ctx.strokeStyle = ghost.color + PALE;
    strokeGhost(chart, ghost);
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
  stroke(ctx, [bbox.left, y], [bbox.left + bbox.width, y]);
  ctx.font = `${11 * px}px system-ui, sans-serif`;
  ctx.textAlign = 'left';
  ctx.textBaseline = 'top';
  ctx.fillText(limit.words, bbox.left + 6 * px, y + 3 * px);
}

function stroke(ctx: CanvasRenderingContext2D, a: Point, b: Point): void {
  ctx.beginPath();
  ctx.moveTo(...a);
  ctx.lineTo(...b);
  ctx.stroke();
}

function strokeGhost(chart: uPlot, { times, values }: Ghost): void {
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
