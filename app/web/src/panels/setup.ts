// What the run was made of.
import type { Run } from '../protocol/run';
import { button, element } from '../ui/dom';
import { row, table } from '../ui/table';

function section(title: string, head: string[], rows: string[][]): HTMLElement {
  const lines = rows.map(([first, ...rest]) => row(first, ...rest.map((text) => element('td', text))));
  return element('section', element('h3', title), element('div.wide', table(head, lines)));
}

function fold(title: string, text: string): HTMLElement {
  return element('details', element('summary', title), element('pre', text));
}

export function setup(run: Run): HTMLElement {
  const root = element('section.setup');
  const copy = button('copy', 'copy the command', () => {
    void navigator.clipboard?.writeText(run.command);
  });
  root.append(
    element('h3', 'Made by'),
    element('div.command', element('code', { id: 'command' }, run.command), copy),
  );
  for (const note of run.notes) root.append(element('p.note', note));
  const facts = element('dl');
  for (const [name, value] of run.facts)
    facts.append(element('dt', name), element('dd', { 'data-fact': name }, value));
  root.append(facts);
  for (const { title, head, rows } of run.tables) root.append(section(title, head, rows));
  for (const { name, text } of run.files) root.append(fold(name, text));
  const licences = document.getElementById('licences');
  if (licences) root.append(fold('Licences of what draws this page', licences.textContent ?? ''));
  return root;
}
