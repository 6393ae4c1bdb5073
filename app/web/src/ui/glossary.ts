// Definitions of docs/reference/glossary.md, inserted by build.mjs.
import { element } from './dom';

declare const GLOSSARY: Record<string, string> | undefined;
const definitions = typeof GLOSSARY === 'undefined' ? {} : GLOSSARY;
const terms = Object.keys(definitions).sort((a, b) => b.length - a.length);

// Tooltip of a text that begins with a term; '': none.
export function definition(text: string): string {
  const term = terms.find((one) => text.toLowerCase().startsWith(one));
  return term ? `${term}: ${definitions[term]}` : '';
}

export function heading(title: string): HTMLElement {
  return element('h3', { title: definition(title) }, title);
}
