// Scale of a parameter's slider: position (0 to 1) of a value and back, arrow-key steps, number as text.
export type Scale = { form: 'log' | 'linear'; low: number; high: number };

const DECADES = 6; // of a logarithmic slider whose lower end is zero
const DIGITS = 3; // significant digits of a value set by a slider

const foot = (scale: Scale): number => (scale.low > 0 ? scale.low : scale.high / 10 ** DECADES);

export function placeOf(scale: Scale, value: number): number {
  const { form, low, high } = scale;
  const decades = (upTo: number) => Math.log(upTo / foot(scale));
  const logShare = value <= 0 ? 0 : decades(value) / decades(high);
  const share = form === 'linear' ? (value - low) / (high - low) : logShare;
  return Number.isFinite(share) ? Math.min(1, Math.max(0, share)) : 0;
}

export function valueAt(scale: Scale, place: number): number {
  const { form, low, high } = scale;
  if (place <= 0) return low;
  if (place >= 1) return high;
  if (form === 'log') return within(scale, round(foot(scale) * (high / foot(scale)) ** place));
  const step = niceStep((high - low) / 1000);
  return within(scale, tidy(Math.round((low + place * (high - low)) / step) * step));
}

// Up (1) or down (-1): by 10 % on a logarithmic scale, by about 1 % of the range on a linear one. Coarse:
// by a factor of two, or ten steps.
export function stepped(scale: Scale, value: number, way: 1 | -1, coarse: boolean): number {
  if (scale.form === 'linear') {
    const step = niceStep((scale.high - scale.low) / 100) * (coarse ? 10 : 1);
    return within(scale, tidy((Math.round(value / step) + way) * step));
  }
  const factor = coarse ? 2 : 1.1;
  if (value <= 0) return way > 0 ? foot(scale) : scale.low;
  const next = round(way > 0 ? value * factor : value / factor);
  return next < foot(scale) ? scale.low : within(scale, next);
}

export function within({ low, high }: { low?: number; high?: number }, value: number): number {
  return Math.min(high ?? Infinity, Math.max(low ?? -Infinity, value));
}

const round = (value: number): number => Number(value.toPrecision(DIGITS));

// Without binary rounding: 0.3 for 0.30000000000000004.
const tidy = (value: number): number => Number(value.toPrecision(12));

// 1, 2 or 5 times a power of ten, at most the size.
export function niceStep(size: number): number {
  const power = 10 ** Math.floor(Math.log10(size) + 1e-9);
  const lead = size / power + 1e-9;
  return tidy((lead >= 5 ? 5 : lead >= 2 ? 2 : 1) * power);
}

// As a field shows it: all digits if they are few, else five.
export function numberText(value: number): string {
  if (!Number.isFinite(value)) return String(value);
  const size = Math.abs(value);
  const text = size !== 0 && (size < 1e-4 || size >= 1e7) ? value.toExponential() : String(value);
  const shorter = size !== 0 && text.length > 8 ? String(Number(value.toPrecision(5))) : text;
  return shorter.replace('e+', 'e');
}

const PREFIXES: Record<string, number> = { M: 1e6, k: 1e3, m: 1e-3, u: 1e-6, µ: 1e-6, μ: 1e-6 };

// "800", "1.2e4", "12k", "12 kN/m", "−3,5 ms", in the parameter's unit. NaN: none of these.
export function parseNumber(text: string, unit: string): number {
  const plain = text.trim().replaceAll('−', '-').replace(',', '.');
  const found = /^([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)\s*(.*)$/i.exec(plain);
  if (!found) return NaN;
  const [, digits, rest] = found;
  const value = Number(digits);
  if (rest === '' || rest === unit) return value;
  const scale = PREFIXES[rest[0]];
  const isScaled = scale !== undefined && (rest.length === 1 || rest.slice(1) === unit);
  return isScaled ? tidy(value * scale) : NaN;
}
