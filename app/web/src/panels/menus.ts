// Menus at the end of the lab's time bar: files to save, messages.
import { button, changeDetector, element, type Status, statusIcon } from '../ui/dom';
import './menus.css';
import type { Note, StateMessage } from '../source/link';
import type { Panel } from './panel';

const FILES: [string, string, string][] = [
  ['/save', 'Recording', 'of the buffered run (.twinrec), for bit-exact replay'],
  ['/share', 'Replay page', 'the same as one HTML file for any browser'],
  ['/scene', 'Scene', 'with the current parameters (.toml)'],
];

export function saveMenu(): HTMLElement {
  const click = () => (menu.open = false);
  const links = FILES.map(([address, name, what]) => {
    const text = [element('b', name), element('span.fine', what)];
    return element('a', { href: address, download: '', click }, ...text);
  });
  const summary = element('summary', { title: 'save, share' }, 'Save');
  const menu = element('details.menu', summary, element('div.sheet', ...links));
  closeOutside(menu);
  return menu;
}

// Closed by Escape and by a press elsewhere.
export function closeOutside(menu: HTMLDetailsElement): void {
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

const SHOWN_FOR = 6000; // [ms]
const ERRORS_SHOWN_FOR = 15_000;
const MAX_TOASTS = 3;
const STATUS: Record<Note['level'], Status> = { note: 'ok', warning: 'near', error: 'beyond' };

// Messages of the lab: new ones as toasts, the last ones in a menu.
export class Notes implements Panel {
  readonly root = element('details.menu.notes');
  private readonly toasts = element('div.toasts', { role: 'log', 'aria-live': 'polite' });
  private readonly list = element('ol.sheet');
  private readonly count = element('summary', { title: 'messages of the lab' }, 'Messages');
  private seen = -1; // number of the newest message; -1: before the first state
  private readonly isNew = changeDetector();

  constructor() {
    this.root.append(this.count, this.list);
    closeOutside(this.root);
    document.body.append(this.toasts);
  }

  onState({ notes }: StateMessage): void {
    const newest = notes.reduce((max, { n }) => Math.max(max, n), 0);
    // No toasts for messages before the page was opened; a restarted lab counts from 1 again.
    const fresh = this.seen < 0 || newest < this.seen ? [] : notes.filter(({ n }) => n > this.seen);
    this.seen = newest;
    const warnings = fresh.filter(({ level }) => level === 'warning');
    if (warnings.length > 1) this.toast({ ...warnings[0], text: `${warnings.length} warnings: see Messages` });
    for (const note of fresh) if (warnings.length < 2 || note.level !== 'warning') this.toast(note);
    if (!this.isNew(newest, notes.length)) return;
    const lines = [...notes].reverse().map((note) => line('li', note));
    this.list.replaceChildren(...(lines.length > 0 ? lines : [element('li', 'No messages.')]));
    this.count.textContent = notes.length > 0 ? `Messages (${notes.length})` : 'Messages';
  }

  private toast(note: Note): void {
    const made = line('div', note);
    made.append(button('×', 'close', () => made.remove(), 'close'));
    this.toasts.append(made);
    while (this.toasts.childElementCount > MAX_TOASTS) this.toasts.firstElementChild!.remove();
    setTimeout(() => made.remove(), note.level === 'error' ? ERRORS_SHOWN_FOR : SHOWN_FOR);
  }
}

function line(tag: 'li' | 'div', { level, text }: Note): HTMLElement {
  return element(tag, { class: `message ${level}` }, statusIcon(STATUS[level] ?? 'ok'), element('span', text));
}
