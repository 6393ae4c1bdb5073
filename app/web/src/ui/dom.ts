// DOM and SVG elements: created in one call, updated in place.
type TagOf<T extends string> = T extends `${infer Tag}.${string}` ? Tag : T;
type Made<T extends string> = TagOf<T> extends keyof HTMLElementTagNameMap ? HTMLElementTagNameMap[TagOf<T>] : never;

// Attributes; functions are listeners to the event of that name.
type Attributes = Record<string, string | ((event: never) => void)>;

// element('p.hint.small', { title: 'attribute' }, 'text', child). Strings become text nodes, never HTML.
export function element<T extends string>(tag: T, ...parts: (Attributes | Node | string)[]): Made<T> {
  const [name, ...classes] = tag.split('.');
  const made = document.createElement(name);
  if (classes.length > 0) made.className = classes.join(' ');
  for (const part of parts) {
    if (typeof part === 'string' || part instanceof Node) made.append(part);
    else
      for (const [key, value] of Object.entries(part))
        if (typeof value === 'string') made.setAttribute(key, value);
        else made.addEventListener(key, value as EventListener);
  }
  return made as Made<T>;
}

export function button(
  label: string | SVGSVGElement | (string | Element)[],
  title: string,
  act: () => void,
  className = '',
): HTMLButtonElement {
  const made = element('button', { type: 'button', title, class: className, click: act }, ...[label].flat());
  const isReadable = Array.isArray(label) || (typeof label === 'string' && label.length >= 3);
  if (!isReadable) made.setAttribute('aria-label', title);
  return made;
}

export function bullets(lines: string[]): HTMLUListElement {
  return element('ul', ...lines.map((line) => element('li', line)));
}

export function option(value: string | number, words = String(value)): HTMLOptionElement {
  return element('option', { value: String(value) }, words);
}

// Drawn, as not every system has letters for them. Paths in a square of 16.
const ICONS = {
  first: 'M3 3h2v10H3zM13 3v10L6 8z',
  back: 'M11 3v10L4 8z',
  step: 'M3 3h2v10H3zM7 3v10l7-5z',
  again: 'M8 2a6 6 0 1 0 6 6h-2a4 4 0 1 1-4-4v3l5-4-5-4z',
  play: 'M4 2.5v11l9-5.5z',
  pause: 'M4 3h3v10H4zM9 3h3v10H9z',
  on: 'M5 3v10l7-5z',
  last: 'M11 3h2v10h-2zM3 3v10l7-5z',
  theme: 'M8 1a7 7 0 1 0 0 14A7 7 0 0 0 8 1zm0 2v10A5 5 0 0 1 8 3z',
  gallery: 'M2 2h5v5H2zM9 2h5v5H9zM2 9h5v5H2zM9 9h5v5H9z',
  full: 'M2 2h4v1.5H3.5V6H2zM10 2h4v4h-1.5V3.5H10zM2 10h1.5v2.5H6V14H2zM12.5 10H14v4h-4v-1.5h2.5z',
  panel: 'M2 3h12v10H2zm1.5 1.5v7h5v-7z',
  layers: 'M8 1.5 15 5 8 8.5 1 5zM2.6 7.2 8 9.9l5.4-2.7L15 8 8 11.5 1 8zm0 3L8 12.9l5.4-2.7L15 11l-7 3.5L1 11z',
};

export function icon(name: keyof typeof ICONS): SVGSVGElement {
  return drawing(ICONS[name], { class: 'icon', 'aria-hidden': 'true' });
}

// One path in a 16 x 16 view box.
export function drawing(path: string, attributes: Record<string, string>): SVGSVGElement {
  return svg('svg', { viewBox: '0 0 16 16', ...attributes }, svg('path', { d: path }));
}

export function svg<K extends keyof SVGElementTagNameMap>(
  tag: K,
  attributes: Record<string, string | number> = {},
  ...children: (Node | string)[]
): SVGElementTagNameMap[K] {
  const made = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
  made.append(...children);
  return made;
}

export const NOISE = 1e-9; // of the largest value beside it: shown as 0

// Four significant digits, or all digits before the point; below NOISE of `scale`: 0.
export function short(value: number | null | undefined, scale = 0): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  const size = Math.abs(value);
  if (size <= NOISE * scale) return '0';
  if (size < 1e-3 || size >= 1e6) return value.toExponential(2).replaceAll('-', '−');
  return (size >= 1e4 ? value.toFixed(0) : value.toPrecision(4)).replaceAll('-', '−');
}

// An unchanged text is neither laid out nor announced again.
export function setText(shown: Element, text: string): void {
  if (shown.textContent !== text) shown.textContent = text;
}

// "kg m^2" as "kg m²".
export function unitText(unit: string): string {
  return unit === '1' ? '' : unit.replaceAll('^2', '²').replaceAll('^3', '³');
}

// A function that returns whether its arguments differ from those of the previous call.
export function changeDetector(): (...now: unknown[]) => boolean {
  let last = '';
  return (...now) => last !== (last = JSON.stringify(now));
}

export function largestOf(values: (number | null)[]): number {
  return values.reduce<number>((max, value) => Math.max(max, Math.abs(value ?? 0)), 0);
}

// Distance to a limit, by shape, colour and text: tick, triangle, octagon.
const STATUS = {
  ok: ['ok', 'M2.5 8.5l3.5 3.5 7.5-8'],
  near: ['near the limit', 'M8 2L15 14H1zM8 6.5v3.5M8 12v.6'],
  beyond: ['beyond the limit', 'M5 1.5h6L15 5.5v5l-4 4H5l-4-4v-5zM5.2 5.2l5.6 5.6M10.8 5.2l-5.6 5.6'],
};
export type Status = keyof typeof STATUS;

export function statusIcon(state: Status): SVGSVGElement {
  const [text, path] = STATUS[state];
  return drawing(path, { class: `status-icon ${state}`, role: 'img', 'aria-label': text });
}

export function statusLine(state: Status, text: string): HTMLElement {
  return element('span', { class: `status ${state}` }, statusIcon(state), element('span', text));
}

// Changes `now` into `wanted` in place: focus, pointer, scroll positions and open details are kept.
export function morph(now: Element, wanted: Element): void {
  const same = (a: Node, b: Node) => a.nodeType === b.nodeType && a.nodeName === b.nodeName;
  for (const { name } of [...now.attributes])
    if (!wanted.hasAttribute(name) && name !== 'open') now.removeAttribute(name);
  for (const { name, value } of wanted.attributes)
    if (now.getAttribute(name) !== value && name !== 'open') now.setAttribute(name, value);
  const to = [...wanted.childNodes];
  to.forEach((node, i) => {
    const old = now.childNodes[i];
    if (!old) now.append(node);
    else if (!same(old, node)) old.replaceWith(node);
    else if (old instanceof Element) morph(old, node as Element);
    else if (old.nodeValue !== node.nodeValue) old.nodeValue = node.nodeValue;
  });
  while (now.childNodes.length > to.length) now.lastChild!.remove();
}

// Definitions of docs/reference/glossary.md, inserted by build.mjs.
declare const GLOSSARY: Record<string, string> | undefined;
const definitions = typeof GLOSSARY === 'undefined' ? {} : GLOSSARY;
const terms = Object.keys(definitions).sort((a, b) => b.length - a.length);

// Tooltip of a text that begins with a term; '': none.
export function definition(text: string): string {
  const term = terms.find((one) => text.toLowerCase().startsWith(one));
  return term ? `${term}: ${definitions[term]}` : '';
}

export const heading = (title: string): HTMLElement => element('h3', { title: definition(title) }, title);
