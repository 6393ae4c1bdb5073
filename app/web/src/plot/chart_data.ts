// Data for uPlot: rows of a window, decimated to the resolution, as lines or stacked areas; and those of the
// previous branch.
import uPlot from 'uplot';
import { token } from '../ui/preferences';
import type { Curve, PlotSpec } from './specs';
import type { RunRecord } from '../source/run_record';
import { type Buckets, bucketsOf, outline, type Points, samples, type Store, timesOf } from '../source/store';

const BRANCH_BUCKETS = 400; // of the previous branch
export const DASH: Record<Curve['style'], number[] | undefined> = {
  line: undefined,
  dashed: [6, 4],
  dotted: [2, 4],
};

export type Window = { from: number; to: number };

export type BranchCurve = { times: number[]; values: Points; color: string };

export const colorOf = (curve: Curve): string => (token(curve.color < 0 ? '--ink' : `--c${curve.color % 8}`));

function scaled(values: Points, factor: number): Points {
  if (factor === 1) return values;
  return values.map((value) => (value === null ? null : value * factor));
}

export function lines(store: Store, buckets: Buckets, curves: Curve[], factor: number): uPlot.AlignedData {
  const values = curves.map(({ column }) => scaled(outline(store.column(column), buckets), factor));
  return [timesOf(store.times, buckets, true), ...values];
}

// Positive values are stacked above zero, negative ones below; the line is their sum.
export function stack(store: Store, buckets: Buckets, curves: Curve[], sum: number): uPlot.AlignedData {
  const times = timesOf(store.times, buckets, false);
  const data: uPlot.AlignedData = [times];
  const parts = curves.map(({ column, rest = [] }) => {
    const columns = [column, ...rest].map((one) => samples(store.column(one), buckets));
    return times.map((_, i) => columns.reduce((sum, values) => sum + (values[i] ?? 0), 0));
  });
  for (const sign of [1, -1]) {
    let edge: number[] = times.map(() => 0);
    data.push(edge);
    for (const part of parts) {
      edge = edge.map((y, i) => y + sign * Math.max(0, sign * part[i]));
      data.push(edge);
    }
  }
  data.push(samples(store.column(sum), buckets));
  return data;
}

type Series = { series: uPlot.Series[]; bands: uPlot.Band[] };

export function lineSeries(curves: Curve[]): Series {
  const series = curves.map((curve) => ({
    stroke: colorOf(curve),
    width: curve.style === 'line' ? 1.75 : 1.5,
    dash: DASH[curve.style],
    points: { show: false },
    auto: curve.color >= 0, // statistics do not determine the range
  }));
  return { series, bands: [] };
}

export function stackSeries(curves: Curve[]): Series {
  const series: uPlot.Series[] = [];
  const bands: uPlot.Band[] = [];
  for (const sign of [1, -1]) {
    series.push({ stroke: 'transparent', points: { show: false } });
    for (const curve of curves) {
      series.push({ stroke: colorOf(curve), width: 0.75, points: { show: false } });
      const at = series.length;
      const pair: [number, number] = sign > 0 ? [at, at - 1] : [at - 1, at];
      bands.push({ series: pair, fill: `${colorOf(curve)}8c` });
    }
  }
  series.push({ stroke: token('--ink'), width: 1.75, points: { show: false } });
  return { series, bands };
}

// Gaps of a curve in canvas pixels: missing values, and missed frames.
export function gapsOf(record: RunRecord): uPlot.Series.GapsRefiner {
  return (chart, _series, _begin, _end, missing) => {
    const pixel = (time: number) => chart.valToPos(time, 'x', true);
    const missed = record.gaps.map(([from, to]): uPlot.Series.Gap => [pixel(from), pixel(to)]);
    let last = -Infinity;
    const ordered = [...missing, ...missed].sort(([one], [other]) => one - other);
    return ordered.map(([from, to]) => [from, last = Math.max(last, to)]);
  };
}

export function branchCurves(record: RunRecord, window: Window, spec: PlotSpec, curves: Curve[], factor: number) {
  const { before } = record;
  if (!before || before.length === 0) return [];
  const begin = Math.max(0, before.after(window.from) - 1);
  const end = Math.min(before.length, before.after(window.to) + 1);
  const buckets = bucketsOf(begin, end, 0, BRANCH_BUCKETS);
  const times = timesOf(before.times, buckets, true);
  const of = (column: number) => scaled(outline(before.column(column), buckets), factor);
  if (spec.sum !== undefined) return [{ times, values: of(spec.sum), color: token('--ink') }];
  const shown = curves.filter((curve) => curve.color >= 0);
  return shown.map((curve) => ({ times, values: of(curve.column), color: colorOf(curve) }));
}

// 90 % of the values are smaller: excludes the last values of a diverged run.
export function usualSize(values: (number | null | undefined)[]): number {
  const known = values.filter((value): value is number => typeof value === 'number');
  const sizes = known.map(Math.abs).sort((one, other) => one - other);
  return sizes[Math.floor(0.9 * sizes.length)] ?? 0;
}

// Shown beside the curves.
export interface ChartExtras {
  usual: number; // magnitude that limits the range; infinite: no limit
  branch: BranchCurve[];
  limit: PlotSpec['limit'];
  sums: number[]; // last values of the statistics
  isForce: boolean;
}

const FAR = 3; // values this many times larger than the curves are left out of the range

// Range of the y axis, with the previous branch, the limit and the statistics.
export function rangeOf(low: number | null, high: number | null, extras: ChartExtras): [number, number] {
  const { usual, branch, limit, sums, isForce } = extras;
  const inner = usual > 0 ? FAR * usual : Infinity;
  let a = Math.max(-inner, low ?? 0);
  let b = Math.min(inner, high ?? 0);
  if (isForce) a = Math.min(a, 0);
  const include = (value: number) => {
    a = Math.min(a, value);
    b = Math.max(b, value);
  };
  const left = branch.flatMap(({ values }) => values);
  const max = FAR * Math.max(Math.abs(a), Math.abs(b), usualSize(left));
  for (const value of left) if (value !== null && Math.abs(value) <= max) include(value);
  const far = FAR * Math.max(Math.abs(a), Math.abs(b));
  for (const sum of sums) if (Math.abs(sum) <= far) include(sum);
  if (limit && (limit.always || b > limit.value / FAR)) {
    include(0);
    include(limit.value);
  }
  if (a === b) return a === 0 ? [-1, 1] : [a - 0.1 * Math.abs(a), b + 0.1 * Math.abs(b)];
  const [from, to] = uPlot.rangeNum(a, b, 0.08, true);
  return [from ?? a, to ?? b];
}
