// Checks by second ways, and warnings.
import type { Check } from '../data/inspection';
import { element, short } from './dom';
import './inspection.css';

export function checkWords(checks: Check[]): string {
  const failed = checks.filter((check) => !check.pass).length;
  return failed > 0 ? `${failed} of ${checks.length} fall short` : `${checks.length} pass`;
}

export function checkTable(checks: Check[], warnings: string[]): HTMLElement {
  const heads = ['', 'found by a second way', 'error', 'tolerance', 'worst at'];
  const rows = checks.map((check) =>
    element(
      'tr',
      { class: check.pass ? 'passes' : 'short' },
      element('th', { scope: 'row' }, `${check.pass ? '✓' : '✗'} ${check.name}`),
      element('td', {}, check.meaning),
      element('td', { class: 'number', title: String(check.error) }, short(check.error)),
      element('td', { class: 'number' }, short(check.tolerance)),
      element('td', {}, check.body),
    ),
  );
  const table = element(
    'table',
    {},
    element('thead', {}, element('tr', {}, ...heads.map((head) => element('th', {}, head)))),
    element('tbody', {}, ...rows),
  );
  const notes = warnings.map((text) => element('p', { class: 'note' }, text));
  return element('section', { class: 'checks' }, ...notes, table);
}
