// Post-mortem of a diverged run: cause, and changes that make it stable.
import './diverged.css';
import { button, changeDetector, element, statusIcon } from '../ui/dom';
import { type Divergence, isViewOnly, type StateMessage } from '../source/link';
import type { LabPage, Panel } from './panel';
import type { Rewind } from '../source/playhead';

const SLOW = 0.1; // playback speed of the last second

export class Diverged implements Panel {
  readonly root = element('section.post-mortem', { role: 'alertdialog', 'aria-label': 'the run has diverged' });
  private readonly isNew = changeDetector();
  private readonly isAnother = changeDetector(); // divergence
  private isClosed = false;
  private focusBefore: Element | null = null;

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
    const { failure, first, at } = state;
    this.root.classList.toggle('small', at !== null); // while an earlier instant is shown
    const isDisabled = isViewOnly(state);
    if (!this.isNew(failure, isDisabled)) return;
    const hasBegun = failure !== null && this.root.hidden;
    if (!failure) this.restoreFocus();
    if (this.isAnother(failure?.time)) this.isClosed = false;
    this.root.hidden = failure === null || this.isClosed;
    if (!failure) return;
    this.root.replaceChildren(...this.content(failure, first, isDisabled));
    if (!hasBegun || this.isClosed) return;
    this.focusBefore = document.activeElement;
    this.root.focus({ preventScroll: true });
  }

  private restoreFocus(): void {
    const { focusBefore: before } = this;
    if (!this.root.contains(document.activeElement)) return;
    const play = document.querySelector<HTMLElement>('.transport .play');
    (before instanceof HTMLElement && before !== document.body ? before : play)?.focus();
  }

  private hide(): void {
    this.isClosed = true;
    this.restoreFocus();
    this.root.hidden = true;
  }

  private content(failure: Divergence, first: number, isDisabled: boolean): Node[] {
    const from = Math.max(first, failure.from);
    const back = `${(failure.time - from).toFixed(1)} s`;
    const changing = (label: string, title: string, act: () => void, className = '') => {
      const made = button(label, title, act, className);
      made.disabled = isDisabled;
      return made;
    };
    const remedies = failure.remedies.map(({ words, changes }, i) => {
      const title = `rewinds ${back} and sets ${changes.join(', ')}`;
      return changing(words, title, () => this.rewind.branch(from, changes), i === 0 ? 'main' : '');
    });
    const none = 'No change that was tried keeps this run stable.';
    const found = remedies.length > 0 ? `Stable settings (rewinds ${back})` : none;
    const heading = element('h3', failure.trying ? 'Trying changes for a stable run …' : found);
    const replay = () => this.rewind.play(Math.max(first, failure.time - 1), SLOW, failure.time);
    return [
      element(
        'header',
        statusIcon('beyond'),
        element('h2', `The run became unstable before t = ${failure.time.toFixed(3)} s`),
        button('×', 'close (Escape)', () => this.hide(), 'close'),
      ),
      ...failure.words.map((line) => element('p', line)),
      heading,
      element('div.remedies', ...remedies),
      element(
        'div.ends',
        button(`Replay the last second at ${SLOW}×`, 'slow motion up to the divergence', replay),
        changing('Restart', 'with the same parameters', () => this.page.send({ do: 'reset' })),
      ),
    ];
  }
}
