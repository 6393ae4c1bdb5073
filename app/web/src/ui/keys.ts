// Keyboard shortcuts and their help.
import { changeSpeed, type Clock } from '../panels/time_bar';
import type { ViewName } from '../view/stage';
import type { Overlays } from '../view/view_options';
import { button, element, icon } from './dom';

type Act = (event: KeyboardEvent) => void;

export interface Key {
  shown: string;
  what: string;
  acts: Record<string, Act>; // by KeyboardEvent.key
}

// One key, or a group of keys.
export function key(shown: string, what: string, acts: Act | Record<string, Act>): Key {
  return { shown, what, acts: typeof acts === 'function' ? { [shown]: acts } : acts };
}

interface ViewTargets {
  orbit(around: number, up: number, closer: number): void;
  look(name: ViewName): void;
  followNext?(): void;
  overlays: Overlays;
  toggleTheme(): void;
}

const PRESSED = 'button, input[type=checkbox]'; // by the space bar
const VIEWS: ViewName[] = ['front', 'side', 'top', 'iso'];

// Keys of the 3-D view, on every page.
export function viewKeys({ orbit, look, followNext, overlays, toggleTheme }: ViewTargets): Key[] {
  let view = 0;
  const digits = [1, 2, 3, 4, 5, 6, 7, 8, 9].map((n) => [n, () => overlays.toggleNumber(n)]);
  const nearer = () => orbit(0, 0, 0.88);
  return [
    ...(followNext ? [key('f', 'follow the selected body, or the next one', followNext)] : []),
    key('a d w s', 'rotate the view', {
      a: () => orbit(-0.1, 0, 1),
      d: () => orbit(0.1, 0, 1),
      w: () => orbit(0, 0.08, 1),
      s: () => orbit(0, -0.08, 1),
    }),
    key('+ −', 'zoom in, out', { '+': nearer, '=': nearer, '-': () => orbit(0, 0, 1 / 0.88) }),
    key('r', 'reset the view', () => look('start')),
    key('v', 'front, side, top, isometric view', () => look(VIEWS[view++ % VIEWS.length])),
    key('o', 'list of overlays', () => overlays.fold(!overlays.folded)),
    ...(overlays.hasNumbers ? [key('1 – 9', 'toggle an overlay', Object.fromEntries(digits))] : []),
    key('t', 'light or dark theme', toggleTheme),
  ];
}

export function clockKeys(clock: Clock): Key[] {
  const toggle = () => clock.toggle();
  return [
    key('space', 'play, pause', { ' ': toggle, k: toggle }),
    key('[ ]', 'slower, faster', { '[': () => changeSpeed(clock, -1), ']': () => changeSpeed(clock, 1) }),
  ];
}

// The button that has the focus because it was clicked: the space bar then plays and pauses as before, and does not
// press it again.
let clicked: Element | null = null;
document.addEventListener('click', ({ target, detail }) => {
  if (detail > 0 && target instanceof Element) clicked = target.closest(PRESSED);
});
document.addEventListener('focusout', () => (clicked = null));

// Whether a field or button handles the key itself.
function isTaken(event: KeyboardEvent): boolean {
  if (event.ctrlKey || event.metaKey || event.altKey) return true;
  const at = event.target;
  if (!(at instanceof Element)) return false;
  if (at.matches('select, textarea, input:is([type=text], [type=number], [type=search])')) return true;
  if (at.matches('input[type=radio]') && /^(Arrow| )/.test(event.key)) return true;
  return at !== clicked && at.matches(PRESSED) && (event.key === ' ' || event.key === 'Enter');
}

// `isKept`: further keys to leave to the focused element.
export function listen(keys: Key[], isKept: (event: KeyboardEvent) => boolean = () => false): void {
  const all = new Map(keys.flatMap(({ acts }) => Object.entries(acts)));
  // In the capture phase: a focused slider would move too.
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

// Dialog with all keys, opened and closed by `?`.
export function help(keys: Key[], mouse: string): HTMLDialogElement {
  const list = element('dl');
  const dialog = element('dialog.help', { 'aria-label': 'keys' });
  const close = button('close', 'Escape', () => dialog.close());
  const toggle = () => (dialog.open ? dialog.close() : dialog.showModal());
  keys.push(key('?', 'this help', toggle));
  for (const { shown, what } of keys)
    list.append(element('dt', element('kbd', shown)), element('dd', what));
  dialog.append(element('h2', 'Keys'), list, element('p.fine', mouse), close);
  return dialog;
}

export const PLOTS = 'Plots: drag to zoom, double-click for the whole run, click or drag the marker to seek.';
export const MOUSE = 'Mouse: drag to rotate, right button to pan, wheel to zoom.';

export function pageHeader(parts: Node[], dialog: HTMLDialogElement, toggleTheme: () => void): HTMLElement {
  return element(
    'header',
    ...parts,
    button('?', 'keys (?)', () => dialog.showModal()),
    button(icon('theme'), 'light or dark theme (t)', toggleTheme),
  );
}
