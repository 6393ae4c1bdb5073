// Equations as print sets them: the plain text that the program writes, to MathML.
import { element } from '../ui/dom';

const SPACE = 'http://www.w3.org/1998/Math/MathML';

function node(tag: string, ...children: (Node | string)[]): MathMLElement {
  const made = document.createElementNS(SPACE, tag);
  made.append(...children);
  return made;
}
const letter = (text: string) => node('mi', text);
export const operator = (text: string) => node('mo', text);
const above = (base: Node, text: string) => node('msup', base, text === '*' ? operator(text) : letter(text));
const below = (base: Node, text: string) => node('msub', base, letter(text));
const dotted = (dots: string) => {
  const made = node('mover', letter('q'), operator(dots));
  made.setAttribute('accent', 'true');
  return made;
};
const inverse = (base: string) => node('msup', letter(base), node('mrow', operator('−'), node('mn', '1')));

// RBDA's letters, as the text has them. lambda: the parent.
const WORDS: Record<string, () => Node> = {
  Xup: () => node('mmultiscripts', letter('X'), letter('λ'), node('mrow'), node('mprescripts'), node('mrow'), letter('i')),
  XJ: () => below(letter('X'), 'J'),
  Xtree: () => below(letter('X'), 'T'),
  v_p: () => below(letter('v'), 'λ'),
  a_p: () => below(letter('a'), 'λ'),
  v_base: () => below(letter('v'), '0'),
  a_base: () => below(letter('a'), '0'),
  cJ: () => below(letter('c'), 'J'),
  vJ: () => below(letter('v'), 'J'),
  qd: () => dotted('˙'),
  qdd: () => dotted('¨'),
  x: () => operator('×'),
  'x*': () => above(operator('×'), '*'),
  f_ext: () => above(letter('f'), 'x'),
  IA: () => above(letter('I'), 'A'),
  Ia: () => above(letter('I'), 'a'),
  pA: () => above(letter('p'), 'A'),
  pa: () => above(letter('p'), 'a'),
  "a'": () => node('msup', letter('a'), operator('′')),
  tau: () => letter('τ'),
  'D^-1': () => inverse('D'),
  'S^T': () => above(letter('S'), 'T'),
  'U^T': () => above(letter('U'), 'T'),
  'X^T': () => above(letter('X'), 'T'),
  sum: () => operator('∑'),
  '-': () => operator('−'),
};
const SILENT = new Set(['', 'of']);

function nodeOf(word: string): Node {
  if (word in WORDS) return WORDS[word]();
  if (/^[\d.]+$/.test(word)) return node('mn', word);
  if (!/^\w+$/.test(word)) return operator(word);
  const [base, index] = word.split('_');
  return index ? below(letter(base), index) : letter(base);
}

export function set(...parts: Node[]): HTMLElement {
  return element('span.math', node('math', node('mrow', ...parts)));
}

export function math(text: string): HTMLElement {
  const words = text.split(/([()\s])/).map((word) => word.trim());
  return set(...words.filter((word) => !SILENT.has(word)).map(nodeOf));
}

// With its sign; what has a power of ten is one row.
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

// "a + (-b) - c": numbers with the signs that stand before them.
export function signedSum(parts: { sign: string; value: number }[]): Node[] {
  return parts.flatMap(({ sign, value }) => {
    const number = mathNumber(value);
    if (!sign) return [number];
    const inside = value < 0 ? [operator('('), number, operator(')')] : [number];
    return [operator(sign === '-' ? '−' : sign), ...inside];
  });
}

export function fraction(over: Node[], under: Node): Node {
  return node('mfrac', node('mrow', ...over), under);
}

// "v = Xup v_p + S qd, table 7.1": the equation, and where it stands.
export function source(text: string): HTMLElement {
  const at = text.search(/, table|, section|; \(/);
  if (!text.includes(' = ')) return element('span', text.replace('table', 'RBDA table'));
  const equation = at < 0 ? text : text.slice(0, at);
  const where = at < 0 ? '' : text.slice(at + 2);
  return element('span', math(equation), ` RBDA ${where}`);
}
