// Quantities of a pass at a body, with their equations and numbers.
import type { Equation, Quantity, Term } from '../protocol/inspection';
import type { BodyInspection } from '../protocol/messages';
import { bold, fraction, math, mathNumber, operator, set, signedSum } from './math';
import { quantityCard, shownValue, unitOfSix } from './quantity';
import { element, largestOf, short, unitText } from '../ui/dom';
import { numberCell, row, table } from '../ui/table';

export function passCards(numbers: BodyInspection, which: number): HTMLElement[] {
  const step = numbers.passes!.find(({ pass }) => pass === which)!;
  const equations = (numbers.equations ?? []).filter(({ pass }) => pass === which);
  const find = (name: string) => equations.find((equation) => equation.name === name || equation.name === `D ${name}`);
  const card = (quantity: Quantity) => {
    const found = find(quantity.name);
    const isOne = typeof quantity.value === 'number';
    const unit = isOne ? quantity.unit : unitOfSix(quantity);
    return quantityCard(quantity, found && block(found, quantity, numbers, unit));
  };
  const before = find("a'");
  const a = step.quantities.find(({ name }) => name === 'a');
  if (!before || !a) return step.quantities.map(card);
  const meaning = 'acceleration for qdd = 0';
  const equation = `${before.text}, table 7.1`;
  return [{ ...a, name: "a'", meaning, equation, value: before.value }, ...step.quantities].map(card);
}

// For one degree of freedom with the division of qdd.
function block(equation: Equation, quantity: Quantity, numbers: BodyInspection, unit: string): Node[] {
  const { name: body = '', passes } = numbers;
  if (equation.name !== 'D qdd') return equationBlock(equation, body, unit);
  const { value } = quantity;
  const D = passes?.find(({ pass }) => pass === 2)?.quantities.find(({ name }) => name === 'D')?.value;
  if (typeof D !== 'number' || typeof value !== 'number') {
    const divided = { ...equation, name: 'qdd', text: 'qdd = D^-1 (D qdd)', terms: [], value };
    return [...equationBlock(equation, body, ''), ...equationBlock(divided, body, unit)];
  }
  const [u, Ua] = equation.terms.map(({ value }) => value as number);
  const over = signedSum([{ sign: '', value: u }, { sign: Ua > 0 ? '+' : '-', value: Math.abs(Ua) }]);
  const parts = [fraction(over, mathNumber(D)), operator('='), bold(mathNumber(value))];
  return [equationLine("qdd = D^-1 ( u - U^T a' )"), line(parts, value, unit)];
}

// An equation with its numbers: vectors as columns, one per term; matrices one below the other; scalars in
// a line.
const ROWS = ['x', 'y', 'z', 'x', 'y', 'z'];
const TOLERANCE = 1e-9; // larger residuals are shown

const isMinus = ({ symbol }: Term): boolean => symbol.startsWith('- ');
// Without the minus of the term. Numbers that are not finite come as null.
function signed(term: Term): number[] {
  const numbers = term.value as number[];
  return isMinus(term) ? numbers.map((number) => (number === null ? number : -number + 0)) : numbers;
}
function whose(term: Term, body: string): string {
  return term.of === body ? term.words : `${term.words} (${term.of})`;
}

// Spatial vectors have an angular and a linear half. A single term equals the result and is omitted.
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
  // Each half has its unit, and so its scale.
  const half = (from: number) => largestOf(parts.flatMap(({ numbers }) => numbers.slice(from, from + 3)));
  const sizes = isSix ? [half(0), half(3)] : [largestOf(parts.flatMap(({ numbers }) => numbers))];
  const heads = parts.flatMap(({ sign, symbol, words }) => [
    element('td.operator', sign),
    element('th', { scope: 'col', title: words }, math(symbol)),
  ]);
  const units = unit.split(';').map((text) => text.trim());
  const rows = value.map((_, k) =>
    row(
      isSix ? ROWS[k] : String(k + 1),
      ...parts.flatMap(({ numbers }, i) => [
        element('td.operator'),
        numberCell(numbers[k], sizes[isSix ? Math.floor(k / 3) : 0], i === parts.length - 1 ? 'total' : ''),
      ]),
      element('td.unit', k % 3 === 0 ? unitText(units[Math.floor(k / 3)] ?? units[0]) : ''),
    )
  );
  const style = { class: isSix ? 'columns six-rows' : 'columns' };
  return element('div.wide', table([element('td'), ...heads, element('td')], rows, style));
}

// The result, and its terms folded.
function matrices(equation: Equation, body: string, unit: string): HTMLElement[] {
  const terms = equation.terms.map((term) => {
    const symbol = element('p.fine', math(term.symbol), ` ${whose(term, body)}`);
    return element('div.term', symbol, shownValue({ value: term.value, unit }));
  });
  const sum = shownValue({ value: equation.value, unit });
  if (terms.length < 2) return [sum];
  return [sum, element('details.terms', element('summary.fine', `${terms.length} terms`), ...terms)];
}

function inLine({ terms, value }: Equation, unit: string): HTMLElement {
  const parts = terms.map((term, i) => ({
    sign: isMinus(term) ? '-' : i > 0 ? '+' : '',
    value: (isMinus(term) ? -1 : 1) * (term.value as number),
  }));
  const left = terms.length > 1 ? [...signedSum(parts), operator('=')] : [];
  return line([...left, bold(mathNumber(value as number))], value as number, unit);
}

function line(parts: Node[], value: number, unit: string): HTMLElement {
  return element('p.line', { title: String(value) }, set(...parts), element('span.unit', ` ${unitText(unit)}`));
}

// Named, since an equation that overflows the panel can have the focus.
function equationLine(text: string): HTMLElement {
  return element('p.set', { role: 'math', 'aria-label': text }, math(text));
}

// `unit` of the left side: "angular; linear".
function equationBlock(equation: Equation, body: string, unit: string): Node[] {
  const { value, residual, text } = equation;
  const parts = [equationLine(text)];
  if (!Array.isArray(value)) parts.push(inLine(equation, unit));
  else if (Array.isArray(value[0])) parts.push(...matrices(equation, body, unit));
  else parts.push(columns(equation, body, unit));
  if (residual === null) parts.push(element('p.note', 'not all numbers are finite'));
  else if (residual > TOLERANCE)
    parts.push(element('p.note', `residual: ${short(residual)} of the largest term`));
  return parts;
}
