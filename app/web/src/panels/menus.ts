// Menus at the end of the lab's time bar: files to save, and notes.
import { button, changeDetector, element, sign, type SignState } from '../ui/dom';
import './menus.css';
import type { Note, StateMessage } from '../source/link';
import type { Panel } from './panel';

const FILES: [string, string, string][] = [
  ['/save', 'Recording', 'the run as it is remembered (.twinrec): replays bit by bit'],
  ['/share', 'Page to share', 'the same in one file that any browser opens'],
  ['/scene', 'Scene', 'as it runs now, all that was turned included (.toml)'],
];

export class SaveMenu {
  readonly root = element('details.menu');

  constructor() {
    const list = element('div.sheet');
    for (const [address, name, what] of FILES) {
      const words = [element('b', name), element('span', what)];
      const link = element('a', { href: address, download: '' }, ...words);
      link.addEventListener('click', () => (this.root.open = false));
      list.append(link);
    }
    this.root.append(element('summary', { title: 'save, share' }, 'Save'), list);
    closesByItself(this.root);
  }
}

// A press elsewhere or Escape closes it.
export function closesByItself(menu: HTMLDetailsElement): void {
  document.addEventListener('pointerdown', (event) => {
    if (menu.open && !menu.contains(event.target as Node)) menu.open = false;
  });
  menu.addEventListener('keydown', (event) => {
    if (event.key !== 'Escape' || !menu.open) return;
    menu.open = false;
    menu.querySelector('summary')!.focus();
    event.stopPropagation();
  });
}

const STAYS = 6000; // [ms]
const LONGER = 15_000; // errors
const MOST = 3; // at a time
const SIGNS: Record<Note['level'], SignState> = { note: 'ok', warning: 'near', error: 'beyond' };

// What the lab says: each note once, for a while, and all of the last ones behind a button.
export class Notes implements Panel {
  readonly root = element('details.menu.notes');
  private readonly toasts = element('div.toasts', { role: 'log', 'aria-live': 'polite' });
  private readonly list = element('ol.sheet');
  private readonly count = element('summary', { title: 'what the lab has said' }, 'Notes');
  private seen = -1; // newest that was shown; before the first state: none
  private readonly isNew = changeDetector();

  constructor() {
    this.root.append(this.count, this.list);
    closesByItself(this.root);
    document.body.append(this.toasts);
  }

  onState({ notes }: StateMessage): void {
    const isFirst = this.seen < 0;
    const newest = notes.reduce((most, { n }) => Math.max(most, n), 0);
    // What was said before this page came is in the list only; a lab that began anew counts anew.
    const fresh = isFirst || newest < this.seen ? [] : notes.filter(({ n }) => n > this.seen);
    this.seen = newest;
    for (const note of fresh) this.toast(note);
    if (!this.isNew(newest, notes.length)) return;
    const lines = [...notes].reverse().map((note) => line('li', note));
    this.list.replaceChildren(...(lines.length > 0 ? lines : [element('li', 'Nothing yet.')]));
    this.count.textContent = notes.length > 0 ? `Notes (${notes.length})` : 'Notes';
  }

  private toast(note: Note): void {
    const made = line('div', note);
    const close = button('×', 'away', () => made.remove(), 'close');
    made.append(close);
    this.toasts.append(made);
    while (this.toasts.childElementCount > MOST) this.toasts.firstElementChild!.remove();
    setTimeout(() => made.remove(), note.level === 'error' ? LONGER : STAYS);
  }
}

function line(tag: 'li' | 'div', { level, text }: Note): HTMLElement {
  const mark = sign(SIGNS[level] ?? 'ok');
  return element(tag, { class: `said ${level}` }, mark, element('span', text));
}
