// Free-body diagram: polygon of all forces on a body, and polygon of all torques. Both close (sum = 0) up
// to the residual.
import type { Balance } from '../protocol/inspection';
import { element, short, svg } from '../ui/dom';
import { niceStep } from '../ui/scale';

const WIDTH = 200;
const HEIGHT = 150;
const MARGIN = 16;

type Point = [number, number];
export type Plane = 'xz' | 'yz' | 'xy';
const PLANES: Plane[] = ['xz', 'yz', 'xy'];
const AXIS = { x: 0, y: 1, z: 2 } as const;

// The plane with the largest components.
function bestPlane(balance: Balance): Plane {
  const spread = [0, 0, 0];
  for (const { force, torque } of balance.wrenches)
    for (let k = 0; k < 3; ++k) spread[k] += (force[k] || 0) ** 2 + (torque[k] || 0) ** 2;
  const hidden = spread.indexOf(Math.min(...spread));
  return PLANES[hidden === 1 ? 0 : hidden === 0 ? 1 : 2];
}

type Segment = { from: Point; to: Point; number: number };

function tipToTail(vectors: number[][], plane: Plane): Segment[] {
  const [a, b] = [AXIS[plane[0] as 'x'], AXIS[plane[1] as 'x']];
  let at: Point = [0, 0];
  return vectors.map((vector, number) => {
    const from = at;
    at = [at[0] + (vector[a] || 0), at[1] + (vector[b] || 0)];
    return { from, to: at, number };
  });
}

function arrow({ from, to, number }: Segment): SVGElement[] {
  const color = `var(--c${number % 8})`;
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const length = Math.hypot(dx, dy);
  if (length < 1.5) return [];
  const [ux, uy] = [dx / length, dy / length];
  const head = Math.min(8, 0.6 * length);
  const neck = [to[0] - head * ux, to[1] - head * uy];
  const side = 0.42 * head;
  const points = [to, [neck[0] - side * uy, neck[1] + side * ux], [neck[0] + side * uy, neck[1] - side * ux]];
  const middle = [(from[0] + to[0]) / 2 - 8 * uy, (from[1] + to[1]) / 2 + 8 * ux];
  const shapes = [
    svg('line', { x1: from[0], y1: from[1], x2: neck[0], y2: neck[1], stroke: color }),
    svg('polygon', { points: points.map((p) => p.join(',')).join(' '), fill: color }),
  ];
  if (length < 18) return shapes;
  return [...shapes, svg('text', { x: middle[0], y: middle[1] + 3.5 }, String(number + 1))];
}

function polygon(vectors: number[][], plane: Plane, unit: string, what: string): HTMLElement {
  const segments = tipToTail(vectors, plane);
  const all = segments.flatMap(({ from, to }) => [from, to]);
  const [xs, ys] = [all.map((p) => p[0]), all.map((p) => p[1])];
  const [left, bottom] = [Math.min(...xs), Math.min(...ys)];
  const [wide, high] = [Math.max(...xs) - left, Math.max(...ys) - bottom];
  const max = Math.max(wide, high);
  const label = `polygon of the ${what} on the body, in the plane ${plane}`;
  const host = svg('svg', { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: 'img', 'aria-label': label });
  const figure = (words: string) => element('figure', host, element('figcaption.fine', words));
  if (!(max > 0) || !Number.isFinite(max)) return figure(max === 0 ? `no ${what} in this plane` : what);
  const space = HEIGHT - 2 * MARGIN - 8;
  const scale = Math.min((WIDTH - 2 * MARGIN) / Math.max(wide, 1e-9 * max), space / Math.max(high, 1e-9 * max));
  const place = ([x, y]: Point): Point => [
    WIDTH / 2 + scale * (x - left - wide / 2),
    MARGIN + space / 2 - scale * (y - bottom - high / 2),
  ];
  const bar = niceStep((0.45 * (WIDTH - 2 * MARGIN)) / scale);
  const y = HEIGHT - 5;
  const [cx, cy] = place([0, 0]);
  host.append(
    ...segments.flatMap(({ from, to, number }) => arrow({ from: place(from), to: place(to), number })),
    svg('circle', { cx, cy, r: 2.4, class: 'start' }),
    svg('path', { d: `M8 ${y - 4}V${y}H${8 + scale * bar}V${y - 4}`, class: 'bar' }),
    svg('text', { x: 13 + scale * bar, y, class: 'length' }, `${+bar.toPrecision(1)} ${unit}`),
  );
  return figure(what);
}

export function diagram(balance: Balance, chosen: Plane | null): HTMLElement {
  const plane = chosen ?? bestPlane(balance);
  const choice = PLANES.map((name) => {
    const state = { 'data-plane': name, 'aria-pressed': String(name === plane) };
    const title = `project to the ${name[0]}–${name[1]} plane`;
    return element('button', { type: 'button', ...state, title }, `${name[0]}–${name[1]}`);
  });
  const forces = balance.wrenches.map(({ force }) => force);
  const torques = balance.wrenches.map(({ torque }) => torque);
  return element(
    'div.diagram',
    element('div.planes', { role: 'group', 'aria-label': 'plane' }, ...choice),
    polygon(forces, plane, 'N', 'forces'),
    polygon(torques, plane, 'N m', 'torques'),
  );
}

export function closing({ residual, largest }: Balance): string {
  return `Each polygon closes at the dot. Residual: ${short(residual)} of the largest, ${short(largest)}.`;
}
