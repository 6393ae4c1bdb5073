// The keyboard. What is said here is what the help shows.
import { changeSpeed, type Clock } from '../panels/time_bar';
import type { ViewName } from '../view/stage';
import { button, element, icon } from './dom';

type Act = (event: KeyboardEvent) => void;

export interface Key {
  shown: string;
  what: string;
  acts: Record<string, Act>; // by KeyboardEvent.key
}

// One key, or several that belong together.
export function key(shown: string, what: string, acts: Act | Record<string, Act>): Key {
  return { shown, what, acts: typeof acts === 'function' ? { [shown]: acts } : acts };
}

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
  const digits = [1, 2, 3, 4, 5, 6, 7, 8, 9].map((n) => [n, () => toggleLayer!(n)]);
  const nearer = () => orbit(0, 0, 0.88);
  return [
    ...(followNext ? [key('f', 'follow the selected body, or the next one', followNext)] : []),
    key('a d w s', 'turn the view', {
      a: () => orbit(-0.1, 0, 1),
      d: () => orbit(0.1, 0, 1),
      w: () => orbit(0, 0.08, 1),
      s: () => orbit(0, -0.08, 1),
    }),
    key('+ −', 'nearer, farther', { '+': nearer, '=': nearer, '-': () => orbit(0, 0, 1 / 0.88) }),
    key('r', 'the view of the start', () => look('start')),
    key('v', 'front, side, top, from a corner', () => look(VIEWS[view++ % VIEWS.length])),
    ...(toggleLayer ? [key('1 – 9', 'show or hide an overlay', Object.fromEntries(digits))] : []),
    key('t', 'light or dark', toggleTheme),
  ];
}

// Of the clock.
export function clockKeys(clock: Clock): Key[] {
  const toggle = () => clock.toggle();
  return [
    key('space', 'play, pause', { ' ': toggle, k: toggle }),
    key('[ ]', 'slower, faster', { '[': () => changeSpeed(clock, -1), ']': () => changeSpeed(clock, 1) }),
  ];
}

// Fields and buttons that take the key themselves keep it.
function isTaken(event: KeyboardEvent): boolean {
  if (event.ctrlKey || event.metaKey || event.altKey) return true;
  const at = event.target;
  if (!(at instanceof Element)) return false;
  if (at.matches('select, textarea, input:is([type=text], [type=number], [type=search])')) return true;
  if (at.matches('input[type=radio]') && /^(Arrow| )/.test(event.key)) return true;
  return at.matches('button, input[type=checkbox]') && (event.key === ' ' || event.key === 'Enter');
}

// `isKept`: besides, keys that somebody else is to have.
export function listen(keys: Key[], isKept: (event: KeyboardEvent) => boolean = () => false): void {
  const all = new Map(keys.flatMap(({ acts }) => Object.entries(acts)));
  // Before others: a focused slider would move by itself too.
  document.addEventListener(
    'keydown',
    (event) => {
      const act = all.get(event.key);
      if (!act || isTaken(event) || isKept(event)) return;
      event.preventDefault();
      act(event);
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
  keys.push(key('?', 'this help', toggle));
  for (const { shown, what } of keys)
    list.append(element('dt', element('kbd', shown)), element('dd', what));
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
