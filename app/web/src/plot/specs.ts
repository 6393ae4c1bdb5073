// The plots of a run and their curves. Quantities without motion or force so far have no curve; a quantity
// keeps its colour.
import type { SceneChannel } from '../source/link';
import type { RunRecord } from '../source/run_record';

export interface Curve {
  column: number; // of the record
  rest?: number[]; // columns added to it
  name: string;
  color: number; // of the theme's; -1: ink
  style: 'line' | 'dashed' | 'dotted';
}

export interface PlotSpec {
  id: string;
  title: string;
  unit: string; // SI
  curves: Curve[];
  sum?: number; // column of the sum of stacked curves
  limit?: { value: number; words: string; always: boolean }; // always: extends the range
  omitted: number;
}

export const DEVICE_LIMIT = 3.3; // [N], nominal maximum force of the Phantom Omni
const VARIANT_TITLES = new Map([['total_energy', 'Total energy'], ['numerical', 'Numerical energy error']]);
const MAX_CURVES = 7; // per plot, with distinguishable colours

type Numbered = SceneChannel & { column: number };

export class PlotSpecs {
  private readonly channels = this.record.scene.channels.map((channel, column) => ({ ...channel, column }));

  // `colors`: by name.
  constructor(private readonly record: RunRecord, readonly colors = new Map<string, number>()) {}

  // `step`: step size of the run [s].
  all(step: number): PlotSpec[] {
    const acting = (kind: string) => this.of(kind).filter(({ column }) => this.size(column) > 0);
    return [
      ...this.variants(),
      ...this.bodies(),
      ...this.coordinates('rad'),
      ...this.error(),
      ...this.energy_balance(),
      ...this.plain('couplings', 'Coupling force / torque', this.of('coupling')),
      ...this.plain('contacts', 'Contact force', acting('contact')),
      ...this.device(),
      ...this.plain('mouse_spring', 'Mouse spring force', acting('mouse_spring')),
      ...this.coordinates('m'),
      ...this.plain('energies', 'Energies', this.of('energy')),
      ...this.plain('contact_laws', 'Contact laws', acting('contacts')),
      ...this.loop(step),
    ].filter((spec) => spec.curves.length > 0);
  }

  // A plot of one quantity.
  single(column: number): PlotSpec | null {
    const channel = this.channels[column];
    if (!channel) return null;
    const curves = [curve(column, channel.name, 0)];
    return { id: 'pick', title: channel.name, unit: channel.unit, curves, omitted: 0 };
  }

  private of(kind: string): Numbered[] {
    return this.channels.filter((channel) => channel.kind === kind);
  }

  private span(column: number): number {
    return Math.max(0, this.record.high[column] - this.record.low[column]);
  }
  private size(column: number): number {
    return Math.max(0, this.record.high[column], -this.record.low[column]);
  }

  // The largest channels, in their order.
  private largest(all: Numbered[], measure: (column: number) => number): Numbered[] {
    if (all.length <= MAX_CURVES) return all;
    const sorted = [...all].sort((a, b) => measure(b.column) - measure(a.column));
    const chosen = new Set(sorted.slice(0, MAX_CURVES));
    return all.filter((channel) => chosen.has(channel));
  }

  // Keeps known colours; new channels get free ones.
  private paint(channels: Numbered[]): number[] {
    const taken = new Set(channels.map(({ name }) => this.colors.get(name)));
    for (const { name } of channels) {
      if (this.colors.has(name)) continue;
      let free = 0;
      while (taken.has(free)) free += 1;
      this.colors.set(name, free);
      taken.add(free);
    }
    return channels.map(({ name }) => this.colors.get(name)!);
  }

  private plain(id: string, title: string, channels: Numbered[], label = labelOf): PlotSpec[] {
    const units = [...new Set(channels.map((channel) => channel.unit))];
    return units.map((unit, i) => {
      const all = channels.filter((channel) => channel.unit === unit);
      const shown = this.largest(all, (column) => this.size(column));
      const colors = this.paint(shown);
      return {
        id: i === 0 ? id : `${id}-${i}`,
        title,
        unit,
        curves: shown.map((channel, k) => curve(channel.column, label(channel), colors[k])),
        omitted: all.length - shown.length,
      };
    });
  }

  // One plot per quantity, one curve per variant, in its colour of the 3-D view.
  private variants(): PlotSpec[] {
    const all = this.of('variant');
    const names = [...new Set(all.map(({ of }) => of))];
    const quantity = ({ name, of }: Numbered) => name.slice('variant/'.length, -of.length - 1);
    return [...new Set(all.map(quantity))].map((what) => {
      const own = all.filter((channel) => quantity(channel) === what);
      const curves = own.map(({ column, of }) => curve(column, of, names.indexOf(of)));
      const [{ unit }] = own;
      const joint = `${unit === 'm' ? 'Position' : 'Angle'}: ${what.slice(what.indexOf('/') + 1)}`;
      const title = VARIANT_TITLES.get(what) ?? joint;
      return { id: `lane-${what.replaceAll('/', '-')}`, title, unit, curves, omitted: 0 };
    });
  }

  // Of a scene without joints.
  private bodies(): PlotSpec[] {
    if (this.of('coordinate').length > 0) return [];
    const moving = this.of('position').filter(({ column }) => this.span(column) > 1e-9);
    return this.plain('bodies', 'Positions', moving, ({ name }) => name.replace('links/', ''));
  }

  // The robot as a line, the target robot dashed in the same colour.
  private coordinates(unit: 'rad' | 'm'): PlotSpec[] {
    const targets = new Map(this.of('target').map((channel) => [channel.of, channel.column]));
    const all = this.of('coordinate').filter(
      (channel) => channel.unit === unit && (targets.has(channel.of) || this.span(channel.column) > 1e-9),
    );
    const driven = all.filter((channel) => targets.has(channel.of)).slice(0, MAX_CURVES);
    if (driven.length === 0 && this.of('variant').length > 0) return []; // shown per variant
    const shown = driven.length > 0 ? driven : this.largest(all, (column) => this.span(column));
    const colors = this.paint(shown);
    const curves = shown.flatMap(({ column, of }, i) => {
      const target = targets.get(of);
      if (target === undefined) return [curve(column, of, colors[i])];
      return [curve(column, of, colors[i]), curve(target, `${of} target`, colors[i], 'dashed')];
    });
    const [id, title] = unit === 'rad' ? ['angles', 'Angles'] : ['positions', 'Positions'];
    return [{ id, title, unit, curves, omitted: all.length - shown.length }];
  }

  private error(): PlotSpec[] {
    return this.record.errors.map(({ unit, channels, max, mean }, i) => {
      const own = channels.map((column) => this.channels[column]);
      const [spec] = this.plain(i === 0 ? 'error' : `error-${unit}`, 'Tracking error (actual − target)', own);
      const statistics = [curve(max, 'maximum so far', -1, 'dashed'), curve(mean, 'mean so far', -1, 'dotted')];
      return { ...spec, curves: [...spec.curves, ...statistics] };
    });
  }

  private energy_balance(): PlotSpec[] {
    const { works, sum, scene } = this.record;
    const all = scene.energy_balance
      .map((of, row): Numbered => ({ name: of, of, unit: 'J', kind: 'energy', column: works + row }))
      .filter(({ column }) => this.size(column) > 0);
    const [spec] = this.plain('energy_balance', 'Energy balance, stacked', all);
    if (!spec) return [];
    const shown = new Set(spec.curves.map(({ column }) => column));
    const [first, ...rest] = all.filter(({ column }) => !shown.has(column)).map(({ column }) => column);
    const name = `${rest.length + 1} smaller rows`;
    const others = first === undefined ? [] : [{ ...curve(first, name, MAX_CURVES), rest }];
    return [{ ...spec, curves: [...spec.curves, ...others], sum, omitted: 0 }];
  }

  private device(): PlotSpec[] {
    const words = `maximum device force, ${DEVICE_LIMIT} N`;
    // Device joint angles are among the coordinates.
    const shown = this.of('device').filter(({ unit }) => unit !== 'rad' && unit !== '1');
    return this.plain('device', 'Motor torques of the device', shown).map((spec) =>
      spec.unit === 'N'
        ? { ...spec, title: 'Device force', limit: { value: DEVICE_LIMIT, words, always: true } }
        : spec
    );
  }

  private loop(step: number): PlotSpec[] {
    const words = 'step size';
    return this.plain('loop', 'Real-time factor', this.of('time')).map((spec) => {
      const value = spec.unit === 'us' ? 1e6 * step : step;
      if (spec.unit !== 's' && spec.unit !== 'us') return spec;
      return { ...spec, title: 'Loop time', limit: { value, words, always: false } };
    });
  }
}

function curve(column: number, name: string, color: number, style: Curve['style'] = 'line'): Curve {
  return { column, name, color, style };
}

// Channels of the run itself have their own names, others those of their joint, coupling or pair.
function labelOf({ name, kind, of }: SceneChannel): string {
  const isOwn = kind === 'device' || kind === 'time' || kind === 'mouse_spring' || kind === 'contacts';
  return isOwn || !of ? name.slice(name.indexOf('/') + 1) : of;
}

// From SI: to degrees if chosen, microseconds, millimetres below 0.1 m.
export function screenUnit(unit: string, degrees: boolean, size: number): { unit: string; factor: number } {
  if (unit === 's') return { unit: 'µs', factor: 1e6 };
  if (unit === 'us') return { unit: 'µs', factor: 1 };
  if (unit === 'm' && size < 0.1) return { unit: 'mm', factor: 1000 };
  if (degrees && unit.startsWith('rad')) return { unit: unit.replace('rad', '°'), factor: 180 / Math.PI };
  return { unit, factor: 1 };
}
