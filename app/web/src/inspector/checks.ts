// Checks by second ways, and warnings.
import type { Check } from '../protocol/inspection';
import { element } from '../ui/dom';
import { numberCell, row, table } from '../ui/table';

export function checkWords(checks: Check[]): string {
  const failed = checks.filter((check) => !check.pass).length;
  return failed > 0 ? `${failed} of ${checks.length} fall short` : `${checks.length} pass`;
}

export function checkTable(checks: Check[], warnings: string[]): HTMLElement {
  const heads = ['', 'found by a second way', 'error', 'tolerance', 'worst at'];
  const rows = checks.map(({ pass, name, meaning, error, tolerance, body }) => {
    const made = row(
      `${pass ? '✓' : '✗'} ${name}`,
      element('td', meaning),
      numberCell(error),
      numberCell(tolerance),
      element('td', body),
    );
    made.classList.toggle('short', !pass);
    return made;
  });
  const notes = warnings.map((text) => element('p.note', text));
  return element('section.checks', ...notes, table(heads, rows));
}
