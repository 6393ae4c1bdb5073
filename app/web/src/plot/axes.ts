// The two axes of every plot: time in seconds below, the quantity at the left; in the theme's colours.
import type uPlot from 'uplot';
import { token } from '../ui/theme';

export function axesOfTime(): uPlot.Axis[] {
  const grid = { stroke: token('--grid'), width: 1 };
  const font = '11px system-ui, sans-serif';
  const axis = { stroke: token('--muted'), grid, ticks: { show: false }, font };
  return [
    { ...axis, size: 24, gap: 2, values: (_, ticks) => ticks.map(timeText) },
    { ...axis, size: 52, gap: 4, values: (_, ticks) => ticks.map(tickText) },
  ];
}

function timeText(time: number): string {
  return `${+time.toPrecision(6)} s`;
}

function tickText(value: number): string {
  if (value === 0) return '0';
  const size = Math.abs(value);
  const isFar = size >= 1e5 || size < 1e-3;
  const far = value.toExponential(1).replace('.0e', 'e');
  const text = isFar ? far : String(+value.toPrecision(4));
  return text.replaceAll('-', '−');
}
