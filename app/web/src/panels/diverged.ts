// When the run has stopped by itself: what, where, why, and what would have held.
import './diverged.css';
import { button, element, sign } from '../ui/dom';
import { type Death, type StateMessage, watches } from '../source/link';
import type { LabPage, Panel } from './panel';
import type { Rewind } from '../source/playhead';

const BEFORE = 1; // a remedy goes back so far [s]
const SLOW = 0.1; // of the last second, when it is looked at

export class Diverged implements Panel {
  readonly root = element('section.post-mortem', { role: 'alertdialog', 'aria-label': 'the run has stopped' });
  private shown = '';
  private away = false; // put aside
  private before: Element | null = null; // had the focus

  constructor(private readonly page: LabPage, private readonly rewind: Rewind) {
    this.root.hidden = true;
    this.root.tabIndex = -1;
    this.root.addEventListener('keydown', (event) => {
      if (event.key !== 'Escape') return;
      this.hide();
      event.stopPropagation();
    });
  }

  onState(state: StateMessage): void {
    const { dead, first, at } = state;
    // While the past is seen, the card makes room.
    this.root.classList.toggle('small', at !== null);
    const isWatching = watches(state);
    const wanted = JSON.stringify([dead, isWatching]);
    if (wanted === this.shown) return;
    const isNew = dead !== null && this.root.hidden;
    if (!dead) this.giveBack();
    if (this.shown === '' || JSON.parse(this.shown)[0]?.time !== dead?.time) this.away = false;
    this.shown = wanted;
    this.root.hidden = dead === null || this.away;
    if (!dead) return;
    this.root.replaceChildren(...this.content(dead, first, isWatching));
    if (!isNew || this.away) return;
    this.before = document.activeElement;
    this.root.focus({ preventScroll: true });
  }

  // The focus, to where it was.
  private giveBack(): void {
    const { before } = this;
    if (!this.root.contains(document.activeElement)) return;
    const play = document.querySelector<HTMLElement>('.transport .play');
    (before instanceof HTMLElement && before !== document.body ? before : play)?.focus();
  }

  private hide(): void {
    this.away = true;
    this.giveBack();
    this.root.hidden = true;
  }

  private content(dead: Death, first: number, isWatching: boolean): Node[] {
    const [headline, ...rest] = dead.words;
    const { quantity, body, spring } = dead;
    const facts = Object.entries({ when: `${dead.time.toFixed(3)} s`, quantity, body, spring })
      .filter(([, value]) => value)
      .map(([name, value]) => element('div', element('dt', name), element('dd', value)));
    const back = Math.max(first, Math.min(dead.from, dead.time - BEFORE));
    const remedies = dead.remedies.map(({ words, changes }, i) => {
      const title = `goes back ${(dead.time - back).toFixed(1)} s with ${changes.join(', ')}`;
      const made = button(words, title, () => this.mend(back, changes), i === 0 ? 'main' : '');
      made.disabled = isWatching;
      return made;
    });
    const look = button('Look at the last second, slowly', 'at a tenth of the speed', () =>
      this.rewind.play(back, SLOW, dead.time),
    );
    const again = button('Begin anew', 'from the start, as it is', () => this.page.send({ do: 'reset' }));
    again.disabled = isWatching;
    const close = button('×', 'put aside (Escape)', () => this.hide(), 'close');
    const title = element('h2', headline ?? 'The run has stopped');
    const parts: Node[] = [
      element('header', sign('beyond'), title, close),
      ...rest.map((line) => element('p', line)),
      element('dl', ...facts),
    ];
    if (remedies.length > 0)
      parts.push(
        element('h3', `What holds, from ${(dead.time - back).toFixed(1)} s before`),
        element('div.remedies', ...remedies),
      );
    return [...parts, element('div.ends', look, again)];
  }

  private mend(at: number, changes: string[]): void {
    this.rewind.look(null);
    this.page.send({ do: 'branch', at, changes }); // which goes on by itself
  }
}
