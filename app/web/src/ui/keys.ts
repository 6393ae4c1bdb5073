// The keyboard. What is said here is what the help shows.
import { changeSpeed, type Clock } from '../panels/time_bar';
import type { ViewName } from '../view/stage';
import { button, element, icon } from './dom';

export interface Key {
  keys: string[]; // of KeyboardEvent.key
  shown: string;
  what: string;
  act: (event: KeyboardEvent) => void;
}

export const key = (keys: string[], shown: string, what: string, act: Key['act']): Key => ({
  keys,
  shown,
  what,
  act,
});

export interface ViewTargets {
  orbit(around: number, up: number, closer: number): void;
  look(name: ViewName): void;
  followNext?(): void;
  toggleLayer?(number: number): void;
  toggleTheme(): void;
}

const VIEWS: ViewName[] = ['front', 'side', 'top', 'iso'];

// Of the picture, on every page.
export function viewKeys({ orbit, look, followNext, toggleLayer, toggleTheme }: ViewTargets): Key[] {
  let view = 0;
  const digits = toggleLayer ? [1, 2, 3, 4, 5, 6, 7, 8, 9] : [];
  return [
    ...(followNext ? [key(['f'], 'f', 'follow the selected body, or the next one', followNext)] : []),
    key(['a'], 'a d w s', 'turn the view', () => orbit(-0.1, 0, 1)),
    key(['d'], '', '', () => orbit(0.1, 0, 1)),
    key(['w'], '', '', () => orbit(0, 0.08, 1)),
    key(['s'], '', '', () => orbit(0, -0.08, 1)),
    key(['+', '='], '+ −', 'nearer, farther', () => orbit(0, 0, 0.88)),
    key(['-'], '', '', () => orbit(0, 0, 1 / 0.88)),
    key(['r'], 'r', 'the view of the start', () => look('start')),
    key(['v'], 'v', 'front, side, top, from a corner', () => look(VIEWS[view++ % VIEWS.length])),
    ...digits.map((n) =>
      key([String(n)], n === 1 ? '1 – 9' : '', 'show or hide an overlay', () => toggleLayer!(n)),
    ),
    key(['t'], 't', 'light or dark', toggleTheme),
  ];
}

// Of the clock.
export function clockKeys(clock: Clock): Key[] {
  return [
    key([' ', 'k'], 'space', 'play, pause', () => clock.toggle()),
    key(['['], '[ ]', 'slower, faster', () => changeSpeed(clock, -1)),
    key([']'], '', '', () => changeSpeed(clock, 1)),
  ];
}

// Fields and buttons that take the key themselves keep it.
function isTaken(event: KeyboardEvent): boolean {
  if (event.ctrlKey || event.metaKey || event.altKey) return true;
  const at = event.target;
  if (at instanceof HTMLSelectElement || at instanceof HTMLTextAreaElement) return true;
  if (at instanceof HTMLInputElement && ['text', 'number', 'search'].includes(at.type)) return true;
  if (at instanceof HTMLInputElement && at.type === 'radio' && /^(Arrow| )/.test(event.key)) return true;
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

// A dialog of all keys, which `?` opens and closes.
export function help(keys: Key[], mouse: string): HTMLDialogElement {
  const list = element('dl');
  const dialog = element('dialog.help', { 'aria-label': 'keys' });
  const close = button('close', 'Escape', () => dialog.close());
  const toggle = () => (dialog.open ? dialog.close() : dialog.showModal());
  keys.push(key(['?'], '?', 'this help', toggle));
  for (const { shown, what } of keys)
    if (shown) list.append(element('dt', element('kbd', shown)), element('dd', what));
  dialog.append(element('h2', 'Keys'), list, element('p', mouse), close);
  return dialog;
}

export const PLOTS =
  'On a plot: a drag zooms, a double click shows all; a click goes to that instant, as does the ' +
  'marker when it is dragged.';
export const MOUSE = 'Mouse: drag turns, right button moves, wheel zooms.';

// The line above everything: what is shown, keys, theme, and what else a page has.
export function pageHeader(parts: Node[], dialog: HTMLDialogElement, toggleTheme: () => void): HTMLElement {
  return element(
    'header',
    ...parts,
    button('?', 'keys (?)', () => dialog.showModal()),
    button(icon('theme'), 'light or dark (t)', toggleTheme),
  );
}
