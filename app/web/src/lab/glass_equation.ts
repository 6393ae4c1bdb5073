// An equation of the passes with its numbers in: columns as on paper, one for each term, with the
// signs between; matrices below one another; of one number all in a line.
import type { Equation, Term } from '../data/glass';
import type { Value } from '../data/inspection';
import { element, largestOf, short, unitText } from '../ui/dom';
import { math, texNumber, texOf } from '../ui/formula';
import { valueOf } from '../ui/quantity';

const ROWS = ['x', 'y', 'z', 'x', 'y', 'z'];
const NOTHING = 1e-9; // larger rests are told

function isMinus({ symbol }: Term): boolean {
  return symbol.startsWith('- ');
}
function bare({ symbol }: Term): string {
  return symbol.replace(/^- /, '');
}
// With the sign that stands before it taken off.
function signed(term: Term): number[] {
  const numbers = term.value as number[];
  // What is not finite comes as null.
  return isMinus(term) ? numbers.map((number) => (number === null ? number : -number + 0)) : numbers;
}
function whose(term: Term, body: string): string {
  return term.of === body ? term.words : `${term.words} (${term.of})`;
}

export function isMatrix(value: Value): value is number[][] {
  return Array.isArray(value) && Array.isArray(value[0]);
}

// Two parts of three, as the book has them; of a joint as many rows as it has velocities. One term
// alone is not told twice.
function columns(equation: Equation, body: string, unit: string): HTMLElement {
  const { name } = equation;
  const terms = equation.terms.length > 1 ? equation.terms : [];
  const value = equation.value as number[];
  const isSix = value.length === 6;
  const parts: { sign: string; symbol: string; words: string; numbers: number[] }[] = terms.map(
    (term, i) => ({
      sign: isMinus(term) ? '−' : i > 0 ? '+' : '',
      symbol: bare(term),
      words: whose(term, body),
      numbers: signed(term),
    }),
  );
  parts.push({ sign: terms.length > 0 ? '=' : '', symbol: name, words: '', numbers: value });
  // Each half has a unit of its own, and so a size.
  const half = (from: number) => largestOf(parts.flatMap(({ numbers }) => numbers.slice(from, from + 3)));
  const sizes = isSix ? [half(0), half(3)] : [largestOf(parts.flatMap(({ numbers }) => numbers))];
  const head = parts.flatMap(({ sign, symbol, words }) => [
    element('td', { class: 'sign' }, sign),
    element('th', { scope: 'col', title: words }, math(texOf(symbol))),
  ]);
  const units = unit.split(';').map((text) => text.trim());
  const rows = value.map((_, k) =>
    element(
      'tr',
      {},
      element('th', { scope: 'row' }, isSix ? ROWS[k] : String(k + 1)),
      ...parts.flatMap(({ numbers }, i) => [
        element('td', { class: 'sign' }),
        element(
          'td',
          { class: i === parts.length - 1 ? 'number total' : 'number', title: String(numbers[k]) },
          short(numbers[k], sizes[isSix ? Math.floor(k / 3) : 0]),
        ),
      ]),
      element('td', { class: 'unit' }, k % 3 === 0 ? unitText(units[Math.floor(k / 3)] ?? units[0]) : ''),
    ),
  );
  const table = element(
    'table',
    { class: isSix ? 'columns six-rows' : 'columns' },
    element('thead', {}, element('tr', {}, element('td'), ...head, element('td'))),
    element('tbody', {}, ...rows),
  );
  return element('div', { class: 'wide' }, table);
}

// What it adds up to stands open, the terms can be opened.
function matrices(equation: Equation, body: string, unit: string): Node[] {
  const terms = equation.terms.map((term) =>
    element(
      'div',
      { class: 'term' },
      element('p', {}, math(texOf(term.symbol)), ` ${whose(term, body)}`),
      valueOf({ value: term.value, unit }),
    ),
  );
  const sum = valueOf({ value: equation.value, unit });
  if (terms.length < 2) return [sum];
  const words = `its ${terms.length} terms`;
  return [sum, element('details', { class: 'terms' }, element('summary', {}, words), ...terms)];
}

function inLine(equation: Equation, unit: string): HTMLElement {
  const numbers = equation.terms.map((term, i) => {
    const value = isMinus(term) ? -(term.value as number) : (term.value as number);
    const sign = isMinus(term) ? '-' : i > 0 ? '+' : '';
    const number = texNumber(value);
    return number.startsWith('-') && sign ? `${sign} (${number})` : `${sign} ${number}`;
  });
  const left = equation.terms.length > 1 ? `${numbers.join(' ')} = ` : '';
  const total = texNumber(equation.value as number);
  return element(
    'p',
    { class: 'line', title: String(equation.value) },
    math(`${left}\\mathbf{${total}}`),
    element('span', { class: 'unit' }, ` ${unitText(unit)}`),
  );
}

// A browser lets the focus stop at an equation that is too wide for the panel: it needs a name.
export function equationLine(text: string): HTMLElement {
  return element('p', { class: 'set', role: 'math', 'aria-label': text }, math(texOf(text)));
}

// `unit` of the left side: of six "angular; linear", of a joint "turning; shifting".
export function equationBlock(equation: Equation, body: string, unit: string): Node[] {
  const { value, residual, text } = equation;
  const numbers: Node[] = isMatrix(value)
    ? matrices(equation, body, unit)
    : Array.isArray(value)
      ? [columns(equation, body, unit)]
      : [inLine(equation, unit)];
  const rest = residual === null || residual > NOTHING;
  const words =
    residual === null ? 'not all numbers are finite' : `but for ${short(residual)} of the largest`;
  return [
    equationLine(text),
    ...numbers,
    ...(rest ? [element('p', { class: 'note' }, words)] : []),
  ];
}
