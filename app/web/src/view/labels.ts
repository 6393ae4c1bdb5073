// Labels at points of the world, drawn over the 3-D view. Overlaps with other labels and controls are avoided
// by moving a label by whole lines or to the other side of its point; a leader line connects both. A label
// without a free place is omitted.
import type { LabelColumns } from '../protocol/run';
import { element, setText, svg } from '../ui/dom';

export type Pixel = { x: number; y: number };
export type Project = (x: number, y: number, z: number) => Pixel | null;

const CONTROLS = ':scope > :not(canvas, .labels, .handles, .corner), .corner > *';
const MAX_WIDTHS = 2000; // remembered
const LINE = 17; // line height in pixels
const LAYOUT_INTERVAL = 300; // [ms]: reading positions makes the browser lay out the page

type Box = Record<'left' | 'top' | 'right' | 'bottom', number>;
type Item = { text: HTMLSpanElement; leader: SVGLineElement };

export class Labels {
  private readonly leaders = svg('svg');
  readonly root = element('div.labels', { 'aria-hidden': 'true' }, this.leaders);
  private readonly items: Item[] = [];
  private readonly pen = document.createElement('canvas').getContext('2d')!;
  private readonly widths = new Map<string, number>(); // of texts, in pixels
  private controls: Box[] = [];
  private measuredAt = -Infinity;

  paint(project: Project, texts: string[], parts: { columns: LabelColumns; frame: number }[]): void {
    if (parts.length > 0 && performance.now() - this.measuredAt > LAYOUT_INTERVAL) {
      this.controls = this.covered();
      this.measuredAt = performance.now();
    }
    const taken = [...this.controls];
    let used = 0;
    for (const { columns, frame } of parts)
      for (let i = columns.first[frame]; i < columns.first[frame + 1]; ++i) {
        const [x, y, z] = columns.position.subarray(3 * i, 3 * i + 3);
        const point = project(x, y, z);
        if (!point) continue;
        const [right, down] = columns.offset.subarray(2 * i, 2 * i + 2);
        const text = texts[columns.text[i]];
        const box = place(point, right, down, this.width(text) + 6, taken);
        if (!box || box.right > this.root.clientWidth || box.left < 0) continue;
        taken.push(box);
        this.put(this.item(used++), text, box, point);
      }
    for (let i = used; i < this.items.length; ++i) {
      this.items[i].text.hidden = true;
      this.items[i].leader.style.display = 'none';
    }
  }

  private width(text: string): number {
    if (this.widths.size > MAX_WIDTHS) this.widths.clear();
    let width = this.widths.get(text);
    if (width === undefined) {
      if (this.widths.size === 0) this.pen.font = getComputedStyle(this.root).font;
      this.widths.set(text, width = this.pen.measureText(text).width);
    }
    return width;
  }

  // Boxes of the controls in the view.
  private covered(): Box[] {
    const { left, top } = this.root.getBoundingClientRect();
    const boxes: Box[] = [];
    for (const other of this.root.parentElement?.querySelectorAll(CONTROLS) ?? []) {
      const { x, y, width, height } = other.getBoundingClientRect();
      if (width > 0) boxes.push(new DOMRect(x - left, y - top, width, height));
    }
    return boxes;
  }

  private put(item: Item, text: string, box: Box, point: Pixel): void {
    item.text.hidden = false;
    setText(item.text, text);
    item.text.style.transform = `translate(${box.left}px, ${box.top}px)`;
    const isLeft = box.right < point.x;
    const end = { x: isLeft ? box.right + 2 : box.left - 2, y: 0.5 * (box.top + box.bottom) };
    const long = Math.hypot(end.x - point.x, end.y - point.y) > 12;
    item.leader.style.display = long ? '' : 'none';
    for (const [name, value] of Object.entries({ x1: point.x, y1: point.y, x2: end.x, y2: end.y }))
      item.leader.setAttribute(name, value.toFixed(1));
  }

  private item(i: number): Item {
    if (!this.items[i]) {
      const text = element('span');
      const leader = svg('line');
      this.root.append(text);
      this.leaders.append(leader);
      this.items[i] = { text, leader };
    }
    return this.items[i];
  }
}

// The nearest free place, right before left.
function place(point: Pixel, right: number, down: number, width: number, taken: Box[]): Box | null {
  const free = ({ left, top, right, bottom }: Box) =>
    taken.every((t) => t.right < left || t.left > right || t.bottom <= top || t.top >= bottom);
  for (const lines of [0, -1, 1, -2, 2, -3, 3, -4, 4])
    for (const left of [point.x + right, point.x - right - width]) {
      const top = point.y + down - 0.5 * LINE + lines * LINE;
      const box = { left, top, right: left + width, bottom: top + LINE };
      if (free(box)) return box;
    }
  return null;
}
