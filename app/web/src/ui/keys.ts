// The keyboard. What is said here is what the help shows.
import { element } from './dom';

export interface Key {
  keys: string[]; // of KeyboardEvent.key
  shown: string;
  what: string;
  act: (event: KeyboardEvent) => void;
}

// Fields and buttons that take the key themselves keep it.
function isTaken(event: KeyboardEvent): boolean {
  if (event.ctrlKey || event.metaKey || event.altKey) return true;
  const at = event.target;
  if (at instanceof HTMLSelectElement || at instanceof HTMLTextAreaElement) return true;
  if (at instanceof HTMLInputElement && ['text', 'number', 'search'].includes(at.type)) return true;
  const checks = at instanceof HTMLInputElement && at.type === 'checkbox';
  const presses = at instanceof HTMLButtonElement || checks;
  return presses && (event.key === ' ' || event.key === 'Enter');
}

// `isKept`: besides, keys that somebody else is to have.
export function listen(keys: Key[], isKept: (event: KeyboardEvent) => boolean = () => false): void {
  const acts = new Map<string, Key>();
  for (const key of keys) for (const name of key.keys) acts.set(name, key);
  // Before others: a focused slider would move by itself too.
  document.addEventListener(
    'keydown',
    (event) => {
      const key = acts.get(event.key);
      if (!key || isTaken(event) || isKept(event)) return;
      event.preventDefault();
      key.act(event);
    },
    { capture: true },
  );
}

export function help(keys: Key[], mouse = MOUSE): HTMLDialogElement {
  const list = element('dl');
  for (const { shown, what } of keys)
    if (shown) list.append(element('dt', {}, element('kbd', {}, shown)), element('dd', {}, what));
  const dialog = element('dialog', { class: 'help', 'aria-label': 'keys' });
  const close = element('button', { type: 'button' }, 'close');
  close.addEventListener('click', () => dialog.close());
  dialog.append(element('h2', {}, 'Keys'), list, element('p', {}, mouse), close);
  return dialog;
}

const MOUSE =
  'Mouse: drag turns, right button moves, wheel zooms. On a plot: drag scrubs, shift and drag ' +
  'zooms, double click shows all.';
