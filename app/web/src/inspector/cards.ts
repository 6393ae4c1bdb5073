// The quantities of a pass at a body, each in its equation where it has one.
import type { Equation } from '../protocol/inspection';
import type { BodyInspection } from '../protocol/messages';
import type { Quantity } from '../protocol/inspection';
import { bold, fraction, math, mathNumber, operator, signedSum, source } from './math';
import { quantityCard, unitOfSix } from './quantity';
import { equationBlock, equationLine, line } from './equation';

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
    const unit =
      typeof quantity.value === 'number' ? unitOf(numbers, quantity.unit) : unitOfSix(quantity);
    return quantityCard(quantity, {
      symbol: math(quantity.name),
      equation: source(quantity.equation),
      content: found && block(found, quantity, numbers, unit),
    });
  };
  const before = find("a'");
  const a = step.quantities.find(({ name }) => name === 'a');
  const as_if: Quantity[] =
    before && a
      ? [
          {
            ...a,
            name: "a'",
            meaning: 'acceleration as if its joint kept still',
            equation: `${before.text}, table 7.1`,
            value: before.value,
          },
        ]
      : [];
  return [...as_if, ...step.quantities].map(card);
}

// Of one degree of freedom the division is shown too.
function block(equation: Equation, quantity: Quantity, numbers: BodyInspection, unit: string): Node[] {
  if (equation.name !== 'D qdd') return equationBlock(equation, numbers.name ?? '', unit);
  const D = numbers.passes
    ?.find(({ pass }) => pass === 2)
    ?.quantities.find(({ name }) => name === 'D')?.value;
  if (typeof D !== 'number' || typeof quantity.value !== 'number')
    return [
      ...equationBlock(equation, numbers.name ?? '', ''),
      ...equationBlock(
        { ...equation, name: 'qdd', text: 'qdd = D^-1 (D qdd)', terms: [], value: quantity.value },
        numbers.name ?? '',
        unit,
      ),
    ];
  const [u, felt] = equation.terms.map(({ value }) => value as number);
  const over = signedSum([{ sign: '', value: u }, { sign: felt > 0 ? '+' : '-', value: Math.abs(felt) }]);
  const parts = [fraction(over, mathNumber(D)), operator('='), bold(mathNumber(quantity.value))];
  return [equationLine("qdd = D^-1 ( u - U^T a' )"), line(parts, quantity.value, unit)];
}
