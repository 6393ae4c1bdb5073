// Equations as print sets them: the plain text that the program tells, to TeX, to MathML. What it
// is set with stands in no page but where this file is imported.
import katex from 'katex';
import { element } from './dom';

// RBDA's letters, as the text has them. lambda: the parent.
const WORDS: Record<string, string> = {
  Xup: '{}^{i}X_{\\lambda}',
  XJ: 'X_{J}',
  Xtree: 'X_{T}',
  v_p: 'v_{\\lambda}',
  a_p: 'a_{\\lambda}',
  v_base: 'v_{0}',
  a_base: 'a_{0}',
  cJ: 'c_{J}',
  vJ: 'v_{J}',
  qd: '\\dot q',
  qdd: '\\ddot q',
  x: '\\times',
  'x*': '\\times^{*}',
  f_ext: 'f^{x}',
  IA: 'I^{A}',
  Ia: 'I^{a}',
  pA: 'p^{A}',
  pa: 'p^{a}',
  "a'": "a'",
  tau: '\\tau',
  'D^-1': 'D^{-1}',
  'S^T': 'S^{T}',
  'U^T': 'U^{T}',
  'X^T': 'X^{T}',
  sum: '\\sum',
  of: '',
};

export function texOf(text: string): string {
  return text
    .split(/([()\s])/)
    .map((word) => {
      if (word in WORDS) return WORDS[word];
      return /^[A-Za-z]{3,}$/.test(word) ? `\\mathrm{${word}}` : word;
    })
    .join(' ');
}

export function texNumber(value: number | null): string {
  if (value === null || !Number.isFinite(value)) return '\\text{–}';
  if (value === 0) return '0';
  const size = Math.abs(value);
  const digits = size < 1e-3 || size >= 1e6 ? value.toExponential(2) : value.toPrecision(4);
  return digits.replace(/e([+-]?)0*(\d+)/, (_, sign, power) => `\\cdot 10^{${sign === '-' ? '-' : ''}${power}}`);
}

const made = new Map<string, Element>(); // setting costs, and the same come again

export function math(tex: string): HTMLElement {
  let found = made.get(tex);
  if (!found) {
    found = element('span', { class: 'math' });
    katex.render(tex, found as HTMLElement, { output: 'mathml', throwOnError: false });
    // The source beside it would be read aloud a second time.
    found.querySelector('annotation')?.remove();
    if (made.size > 4000) made.clear(); // numbers change for ever
    made.set(tex, found);
  }
  return found.cloneNode(true) as HTMLElement;
}

// "v = Xup v_p + S qd, table 7.1": the equation, and where it stands.
export function source(text: string): HTMLElement {
  const at = text.search(/, table|, section|; \(/);
  if (!text.includes(' = ')) return element('span', {}, text.replace('table', 'RBDA table'));
  const equation = at < 0 ? text : text.slice(0, at);
  const where = at < 0 ? '' : text.slice(at + 2);
  return element('span', {}, math(texOf(equation)), ` RBDA ${where}`);
}
