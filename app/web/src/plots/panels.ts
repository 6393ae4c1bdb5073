// Which plots a run gets: curves by what they are, at most a few in one plot.
import type { Channel, Run } from '../data/run';

export interface Curve {
  name: string;
  values: Float64Array;
  color: number; // index into the theme's colours
  dashed?: boolean;
}

export interface PanelSpec {
  id: string;
  title: string;
  unit: string; // as it stands at the axis
  curves: Curve[];
  stacked?: { total: Float64Array; name: string }; // areas upon each other, and their sum as a line
  omitted?: number; // curves that found no room
}

const MOST = 7; // curves that the eye can tell apart
const DEGREES = 180 / Math.PI;

// Screens show degrees and millimetres; what is stored is SI.
export function screenUnit(unit: string, most = Infinity): { unit: string; factor: number } {
  if (unit === 'm' && most < 0.1) return { unit: 'mm', factor: 1000 };
  if (unit === 'rad') return { unit: '°', factor: DEGREES };
  if (unit === 'rad/s') return { unit: '°/s', factor: DEGREES };
  return { unit, factor: 1 };
}

function scaled(values: Float64Array, factor: number): Float64Array {
  return factor === 1 ? values : values.map((value) => value * factor);
}

function largest(values: Float64Array): number {
  return values.reduce((most, value) => Math.max(most, Math.abs(value) || 0), 0);
}

function span(values: Float64Array): number {
  let low = Infinity;
  let high = -Infinity;
  for (const value of values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return high - low;
}

// Those with the largest measure, in their own order.
function most<T>(items: T[], measure: (item: T) => number): T[] {
  if (items.length <= MOST) return items;
  const chosen = new Set([...items].sort((a, b) => measure(b) - measure(a)).slice(0, MOST));
  return items.filter((item) => chosen.has(item));
}

function plain(
  id: string,
  title: string,
  channels: Channel[],
  label: (channel: Channel) => string = (channel) => channel.of,
): PanelSpec[] {
  const units = [...new Set(channels.map((channel) => channel.unit))];
  return units.map((unit, i) => {
    const all = channels.filter((channel) => channel.unit === unit);
    const shown = most(all, (channel) => largest(channel.values));
    const screen = screenUnit(unit, Math.max(...shown.map((channel) => largest(channel.values))));
    return {
      id: i === 0 ? id : `${id}-${i}`,
      title,
      unit: screen.unit,
      omitted: all.length - shown.length,
      curves: shown.map((channel, color) => ({
        name: label(channel),
        values: scaled(channel.values, screen.factor),
        color,
      })),
    };
  });
}

// The dynamic robot as a line, the kinematic one in the same colour, dashed.
function coordinates(run: Run, unit: 'rad' | 'm'): PanelSpec[] {
  const of = (kind: Channel['kind']) => run.channels.filter((channel) => channel.kind === kind);
  const targets = new Map(of('target').map((channel) => [channel.name, channel]));
  const moving = of('coordinate').filter((channel) => channel.unit !== '1');
  const all = moving.filter((channel) => channel.unit === unit && span(channel.values) > 1e-9);
  const led = all.filter((channel) => targets.has(`target/${channel.of}`));
  const shown = led.length > 0 ? led.slice(0, MOST) : most(all, (c) => span(c.values));
  if (shown.length === 0) return [];
  const screen = screenUnit(unit, Math.max(...shown.map((channel) => largest(channel.values))));
  const curves: Curve[] = [];
  shown.forEach((channel, color) => {
    const values = scaled(channel.values, screen.factor);
    const target = targets.get(`target/${channel.of}`);
    curves.push({ name: target ? `${channel.of} DVR` : channel.of, values, color });
    if (!target) return;
    const wanted = scaled(target.values, screen.factor);
    curves.push({ name: `${channel.of} KVR`, values: wanted, color, dashed: true });
  });
  const title = unit === 'rad' ? 'Angles' : 'Positions';
  const omitted = all.length - shown.length;
  return [{ id: title.toLowerCase(), title, unit: screen.unit, curves, omitted }];
}

function ledger(run: Run): PanelSpec[] {
  const { rows, works } = run.ledger;
  if (rows.length === 0) return [];
  const count = run.times.length;
  const column = (row: number) =>
    Float64Array.from({ length: count }, (_, frame) => works[frame * rows.length + row]);
  const all = rows.map((name, row) => ({ name, values: column(row) }));
  const shown = most(all, (row) => largest(row.values));
  const rest = all.filter((row) => !shown.includes(row));
  const curves: Curve[] = shown.map(({ name, values }, color) => ({ name, values, color }));
  const sumOf = (parts: { values: Float64Array }[]) =>
    Float64Array.from({ length: count }, (_, frame) =>
      parts.reduce((sum, part) => sum + part.values[frame], 0),
    );
  if (rest.length > 0)
    curves.push({ name: `${rest.length} smaller rows`, values: sumOf(rest), color: MOST });
  return [
    {
      id: 'ledger',
      title: 'Energy ledger, stacked',
      unit: 'J',
      curves,
      stacked: { total: sumOf(all), name: 'sum: change of kinetic energy' },
    },
  ];
}

// Of a scene without joints.
function bodies(run: Run): PanelSpec[] {
  if (run.channels.some((channel) => channel.kind === 'coordinate')) return [];
  const moving = run.channels.filter((c) => c.kind === 'position' && span(c.values) > 1e-9);
  return plain('bodies', 'Positions', moving, (channel) => channel.name.replace('links/', ''));
}

export function panelsOf(run: Run): PanelSpec[] {
  const of = (kind: Channel['kind']) => run.channels.filter((channel) => channel.kind === kind);
  const acting = (kind: Channel['kind']) => of(kind).filter((c) => largest(c.values) > 0);
  return [
    ...bodies(run),
    ...coordinates(run, 'rad'),
    ...plain('error', 'Error: DVR less KVR', acting('error')),
    ...ledger(run),
    ...plain('couplings', 'Pull of the couplings', acting('coupling')),
    ...plain('contacts', 'Contact force', acting('contact')),
    ...coordinates(run, 'm'),
    ...plain('energies', 'Energies', of('energy')),
  ];
}
