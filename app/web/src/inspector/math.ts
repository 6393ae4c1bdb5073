// Plain-text equations of the program as MathML.
import { element } from '../ui/dom';

const SPACE = 'http://www.w3.org/1998/Math/MathML';

function node(tag: string, ...children: (Node | string)[]): MathMLElement {
  const made = document.createElementNS(SPACE, tag);
  made.append(...children);
  return made;
}
const letter = (text: string) => node('mi', text);
export const operator = (text: string) => node('mo', text);
const over = (base: Node, script: Node) => node('msup', base, script);
const dotted = (dots: string) => {
  const made = node('mover', letter('q'), operator(dots));
  made.setAttribute('accent', 'true');
  return made;
};

// Letters of RBDA with scripts; λ is the parent.
// dprint-ignore
const SCRIPTS: Record<string, string> = {
  XJ: 'X_J', Xtree: 'X_T', v_p: 'v_λ', a_p: 'a_λ', v_base: 'v_0', a_base: 'a_0', cJ: 'c_J', vJ: 'v_J',
  f_ext: 'f^x', IA: 'I^A', Ia: 'I^a', pA: 'p^A', pa: 'p^a',
};
const SYMBOLS: Record<string, () => Node> = {
  Xup: () =>
    node('mmultiscripts', letter('X'), letter('λ'), node('mrow'), node('mprescripts'), node('mrow'), letter('i')),
  qd: () => dotted('˙'),
  qdd: () => dotted('¨'),
  x: () => operator('×'),
  'x*': () => over(operator('×'), operator('*')),
  "a'": () => over(letter('a'), operator('′')),
  'D^-1': () => over(letter('D'), node('mrow', operator('−'), node('mn', '1'))),
  tau: () => letter('τ'),
  sum: () => operator('∑'),
  '-': () => operator('−'),
};
const SILENT = new Set(['', 'of']);

function nodeOf(word: string): Node {
  if (word in SYMBOLS) return SYMBOLS[word]();
  if (/^[\d.]+$/.test(word)) return node('mn', word);
  const [, base, kind, script] = /^(\w+?)([_^])([\wλ]+)$/.exec(SCRIPTS[word] ?? word) ?? [];
  if (kind) return node(kind === '_' ? 'msub' : 'msup', letter(base), letter(script));
  return /^\w+$/.test(word) ? letter(word) : operator(word);
}

export function set(...parts: Node[]): HTMLElement {
  return element('span.math', node('math', node('mrow', ...parts)));
}

export function math(text: string): HTMLElement {
  const words = text.split(/([()\s])/).map((word) => word.trim());
  return set(...words.filter((word) => !SILENT.has(word)).map(nodeOf));
}

export function mathNumber(value: number | null): Node {
  if (value === null || !Number.isFinite(value)) return node('mtext', '–');
  if (value === 0) return node('mn', '0');
  const size = Math.abs(value);
  const isFar = size < 1e-3 || size >= 1e6;
  const [digits, power] = (isFar ? size.toExponential(2) : size.toPrecision(4)).split('e');
  const made = node('mrow', ...(value < 0 ? [operator('−')] : []), node('mn', digits));
  const sign = power?.startsWith('-') ? [operator('−')] : [];
  if (power)
    made.append(
      operator('·'),
      node('msup', node('mn', '10'), node('mrow', ...sign, node('mn', power.replace(/^[+-]/, '')))),
    );
  return made;
}

export function bold(part: Node): Node {
  const made = node('mrow', part);
  made.setAttribute('class', 'total');
  return made;
}

// "a + (-b) - c"
export function signedSum(parts: { sign: string; value: number }[]): Node[] {
  return parts.flatMap(({ sign, value }) => {
    const number = mathNumber(value);
    if (!sign) return [number];
    const inside = value < 0 ? [operator('('), number, operator(')')] : [number];
    return [operator(sign === '-' ? '−' : sign), ...inside];
  });
}

export const fraction = (over: Node[], under: Node): Node => node('mfrac', node('mrow', ...over), under);

// "v = Xup v_p + S qd, table 7.1": the equation, and its place in RBDA.
export function source(text: string): HTMLElement {
  const at = text.search(/, table|, section|; \(/);
  if (!text.includes(' = ')) return element('span', text.replace('table', 'RBDA table'));
  const equation = at < 0 ? text : text.slice(0, at);
  const where = at < 0 ? '' : text.slice(at + 2);
  return element('span', math(equation), ` RBDA ${where}`);
}
