// Export of numbers and plots as files.
import { element } from '../ui/dom';
import { token } from '../ui/preferences';

export interface CsvColumn {
  name: string;
  unit: string;
  value: (row: number) => number;
}

// CSV (RFC 4180) with all digits; NaN is empty.
export function csvText(columns: CsvColumn[], rows: number): string {
  const quoted = (text: string) => (/[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
  const lines = [columns.map(({ name, unit }) => quoted(unit ? `${name} [${unit}]` : name)).join()];
  const text = (value: number) => (Number.isNaN(value) ? '' : String(value));
  for (let row = 0; row < rows; ++row) lines.push(columns.map(({ value }) => text(value(row))).join());
  return `${lines.join('\r\n')}\r\n`;
}

export function download(name: string, content: Blob): void {
  const address = URL.createObjectURL(content);
  const link = element('a', { href: address, download: name });
  link.click();
  // Later, since the browser still reads it.
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

// "Hand and obstacles", "error": "hand-and-obstacles-error.csv".
export function fileName(title: string, what: string, ending: string): string {
  const plain = `${title}-${what}`.toLowerCase().replaceAll(/[^\p{L}\p{N}]+/gu, '-');
  return `${plain.replaceAll(/^-+|-+$/g, '')}.${ending}`;
}

type PictureLine = { name: string; color: string; dash: number[] };

// A plot's canvas with title and legend, on the background of the theme.
export function savePicture(name: string, title: string, plot: HTMLCanvasElement, lines: PictureLine[]): void {
  const scale = plot.width / plot.clientWidth || 1;
  const row = 18 * scale;
  const canvas = element('canvas');
  const context = canvas.getContext('2d')!;
  const font = `${12 * scale}px system-ui, sans-serif`;
  context.font = font;
  const widths = lines.map((line) => context.measureText(line.name).width + 40 * scale);
  const places: [number, number][] = [];
  let x = 8 * scale;
  let y = 0;
  for (const width of widths) {
    if (x + width > plot.width && x > 8 * scale) {
      x = 8 * scale;
      y += row;
    }
    places.push([x, y]);
    x += width;
  }
  canvas.width = plot.width;
  canvas.height = plot.height + y + 2.5 * row;
  context.fillStyle = token('--surface');
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.drawImage(plot, 0, row);
  context.fillStyle = token('--ink');
  context.font = `600 ${13 * scale}px system-ui, sans-serif`;
  context.fillText(title, 8 * scale, 14 * scale);
  context.font = font;
  context.lineWidth = 2.5 * scale;
  lines.forEach((line, i) => {
    const [left, down] = places[i];
    const base = plot.height + 2 * row + down;
    context.strokeStyle = line.color;
    context.setLineDash(line.dash.map((length) => length * scale));
    context.beginPath();
    context.moveTo(left, base - 4 * scale);
    context.lineTo(left + 18 * scale, base - 4 * scale);
    context.stroke();
    context.fillText(line.name, left + 24 * scale, base);
  });
  canvas.toBlob((blob) => blob && download(name, blob));
}
