// The quantities of a pass at a body, each in its equation where it has one.
import type { Equation, Quantity, Term } from '../protocol/inspection';
import type { BodyInspection } from '../protocol/messages';
import { bold, fraction, math, mathNumber, operator, set, signedSum } from './math';
import { quantityCard, unitOfSix, valueOf } from './quantity';
import { element, largestOf, short, unitText } from '../ui/dom';
import { numberCell, row, table } from '../ui/table';

// Of a joint: the first where it turns, the second where it shifts.
export function unitOf({ passes }: BodyInspection, unit: string): string {
  const S = passes?.[0].quantities.find(({ name }) => name === 'S')?.value;
  const [turn, shift] = unit.split(';').map((text) => text.trim());
  if (!S || !shift) return unit;
  if (typeof (S as number[])[0] !== 'number') return unit;
  return (S as number[]).slice(0, 3).every((part) => part === 0) ? shift : turn;
}

// Each quantity of the pass, in its equation where it has one.
export function passCards(numbers: BodyInspection, which: number): HTMLElement[] {
  const step = numbers.passes!.find(({ pass }) => pass === which)!;
  const equations = (numbers.equations ?? []).filter(({ pass }) => pass === which);
  const find = (name: string) =>
    equations.find((equation) => equation.name === name || equation.name === `D ${name}`);
  const card = (quantity: Quantity) => {
    const found = find(quantity.name);
    const isOne = typeof quantity.value === 'number';
    const unit = isOne ? unitOf(numbers, quantity.unit) : unitOfSix(quantity);
    return quantityCard(quantity, found && block(found, quantity, numbers, unit));
  };
  const before = find("a'");
  const a = step.quantities.find(({ name }) => name === 'a');
  if (!before || !a) return step.quantities.map(card);
  const meaning = 'acceleration as if its joint kept still';
  const asIf = { ...a, name: "a'", meaning, equation: `${before.text}, table 7.1`, value: before.value };
  return [asIf, ...step.quantities].map(card);
}

// Of one degree of freedom the division is shown too.
function block(equation: Equation, quantity: Quantity, numbers: BodyInspection, unit: string): Node[] {
  const { name: body = '', passes } = numbers;
  if (equation.name !== 'D qdd') return equationBlock(equation, body, unit);
  const { value } = quantity;
  const D = passes?.find(({ pass }) => pass === 2)?.quantities.find(({ name }) => name === 'D')?.value;
  if (typeof D !== 'number' || typeof value !== 'number') {
    const divided = { ...equation, name: 'qdd', text: 'qdd = D^-1 (D qdd)', terms: [], value };
    return [...equationBlock(equation, body, ''), ...equationBlock(divided, body, unit)];
  }
  const [u, felt] = equation.terms.map(({ value }) => value as number);
  const over = signedSum([{ sign: '', value: u }, { sign: felt > 0 ? '+' : '-', value: Math.abs(felt) }]);
  const parts = [fraction(over, mathNumber(D)), operator('='), bold(mathNumber(value))];
  return [equationLine("qdd = D^-1 ( u - U^T a' )"), line(parts, value, unit)];
}

// An equation of the passes with its numbers in: columns as on paper, one for each term, with the
// signs between; matrices below one another; of one number all in a line.
const ROWS = ['x', 'y', 'z', 'x', 'y', 'z'];
const NOTHING = 1e-9; // larger rests are told

function isMinus({ symbol }: Term): boolean {
  return symbol.startsWith('- ');
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

// Two parts of three, as the book has them; of a joint as many rows as it has velocities. One term
// alone is not told twice.
function columns(equation: Equation, body: string, unit: string): HTMLElement {
  const terms = equation.terms.length > 1 ? equation.terms : [];
  const value = equation.value as number[];
  const isSix = value.length === 6;
  const parts = terms.map((term, i) => {
    const sign = isMinus(term) ? '−' : i > 0 ? '+' : '';
    const symbol = term.symbol.replace(/^- /, '');
    return { sign, symbol, words: whose(term, body), numbers: signed(term) };
  });
  parts.push({ sign: terms.length > 0 ? '=' : '', symbol: equation.name, words: '', numbers: value });
  // Each half has a unit of its own, and so a size.
  const half = (from: number) => largestOf(parts.flatMap(({ numbers }) => numbers.slice(from, from + 3)));
  const sizes = isSix ? [half(0), half(3)] : [largestOf(parts.flatMap(({ numbers }) => numbers))];
  const heads = parts.flatMap(({ sign, symbol, words }) => [
    element('td.sign', sign),
    element('th', { scope: 'col', title: words }, math(symbol)),
  ]);
  const units = unit.split(';').map((text) => text.trim());
  const rows = value.map((_, k) =>
    row(
      isSix ? ROWS[k] : String(k + 1),
      ...parts.flatMap(({ numbers }, i) => [
        element('td.sign'),
        numberCell(numbers[k], sizes[isSix ? Math.floor(k / 3) : 0], i === parts.length - 1 ? 'total' : ''),
      ]),
      element('td.unit', k % 3 === 0 ? unitText(units[Math.floor(k / 3)] ?? units[0]) : ''),
    ),
  );
  const style = { class: isSix ? 'columns six-rows' : 'columns' };
  return element('div.wide', table([element('td'), ...heads, element('td')], rows, style));
}

// What it adds up to stands open, the terms can be opened.
function matrices(equation: Equation, body: string, unit: string): HTMLElement[] {
  const terms = equation.terms.map((term) => {
    const words = element('p', math(term.symbol), ` ${whose(term, body)}`);
    return element('div.term', words, valueOf({ value: term.value, unit }));
  });
  const sum = valueOf({ value: equation.value, unit });
  if (terms.length < 2) return [sum];
  const words = `its ${terms.length} terms`;
  return [sum, element('details.terms', element('summary', words), ...terms)];
}

function inLine({ terms, value }: Equation, unit: string): HTMLElement {
  const parts = terms.map((term, i) => ({
    sign: isMinus(term) ? '-' : i > 0 ? '+' : '',
    value: (isMinus(term) ? -1 : 1) * (term.value as number),
  }));
  const left = terms.length > 1 ? [...signedSum(parts), operator('=')] : [];
  return line([...left, bold(mathNumber(value as number))], value as number, unit);
}

// All digits stand at the pointer.
function line(parts: Node[], value: number, unit: string): HTMLElement {
  const words = element('span.unit', ` ${unitText(unit)}`);
  return element('p.line', { title: String(value) }, set(...parts), words);
}

// A browser lets the focus stop at an equation that is too wide for the panel: it needs a name.
function equationLine(text: string): HTMLElement {
  return element('p.set', { role: 'math', 'aria-label': text }, math(text));
}

// `unit` of the left side: of six "angular; linear", of a joint "turning; shifting".
function equationBlock(equation: Equation, body: string, unit: string): Node[] {
  const { value, residual, text } = equation;
  const parts = [equationLine(text)];
  if (!Array.isArray(value)) parts.push(inLine(equation, unit));
  else if (Array.isArray(value[0])) parts.push(...matrices(equation, body, unit));
  else parts.push(columns(equation, body, unit));
  if (residual === null) parts.push(element('p.note', 'not all numbers are finite'));
  else if (residual > NOTHING) parts.push(element('p.note', `but for ${short(residual)} of the largest`));
  return parts;
}
