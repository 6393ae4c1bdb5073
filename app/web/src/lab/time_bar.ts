// The bar below the view: whether the run goes on, how fast, and which of its instants is seen.
import { button, element, icon } from '../ui/dom';
import { BranchDialog } from './branch_dialog';
import { watches, type Frame, type StateMessage } from './link';
import type { LabPage, Panel } from './panel';
import { Rewind } from './rewind';
import { SaveMenu } from './save_menu';

const SPEEDS = [0.01, 0.1, 0.25, 0.5, 1, 2, 5, 10];
const SPEED_WORDS = ['1/100', '1/10', '1/4', '1/2', '1', '2', '5', '10'];
const REAL_TIME = 0.015; // nearer to 1 is real time
const PLACES = 10_000; // of the slider

export class TimeBar implements Panel {
  readonly root = element('footer', { class: 'transport lab-time', 'aria-label': 'time' });
  readonly rewind: Rewind;
  private readonly play: HTMLButtonElement;
  private readonly step: HTMLButtonElement;
  private readonly again: HTMLButtonElement;
  private readonly branch: HTMLButtonElement;
  private readonly present: HTMLButtonElement;
  private readonly speed = element('select', { title: 'speed of the run', 'aria-label': 'speed' });
  private readonly slider: HTMLInputElement;
  private readonly fork = element('i', { class: 'fork', 'aria-hidden': 'true' });
  private readonly end = element('i', { class: 'death', 'aria-hidden': 'true' });
  private readonly clock = element('output', { class: 'clock', 'aria-live': 'off' });
  private readonly where = element('output', { class: 'where' });
  private readonly dialog: BranchDialog;
  private readonly ends = element('div', { class: 'buttons' });
  private readonly added: Panel[] = [];
  private scrubbing = false;
  private shown = '';

  constructor(
    private readonly page: LabPage,
    changes: () => string[],
  ) {
    this.rewind = new Rewind(page);
    this.dialog = new BranchDialog(page, this.rewind, changes);
    this.play = button(icon('play'), 'go on or stand (space)', () => this.toggle(), 'play');
    this.step = button(icon('step'), 'one step', () => this.single());
    this.again = button(icon('again'), 'to the start: the run begins anew', () =>
      this.page.send({ do: 'reset' }),
    );
    this.branch = button('branch …', 'go on from this instant, with other knobs', () =>
      this.askBranch(),
    );
    this.present = button('to now', 'to the newest instant', () => this.rewind.seek(null));
    this.slider = element('input', {
      type: 'range',
      min: '0',
      max: String(PLACES),
      step: '1',
      'aria-label': 'instant of the run, back over what is remembered',
    });
    SPEEDS.forEach((speed, i) =>
      this.speed.append(element('option', { value: String(speed) }, `${SPEED_WORDS[i]}×`)),
    );
    this.speed.addEventListener('change', () =>
      this.page.send({ do: 'speed', factor: Number(this.speed.value) }),
    );
    this.scrub();
    this.root.append(
      element('div', { class: 'track' }, this.slider, this.fork, this.end),
      element(
        'div',
        { class: 'row' },
        element('div', { class: 'buttons' }, this.play, this.step, this.again, this.speed),
        element('div', { class: 'reading' }, this.clock, this.where),
        this.ends,
      ),
      this.dialog.root,
    );
    this.ends.append(this.branch, this.present, new SaveMenu().root);
  }

  // Stands at the end of the bar, and hears what the lab says.
  add(panel: Panel): void {
    this.added.push(panel);
    this.ends.append(panel.root);
  }

  onState(state: StateMessage): void {
    for (const panel of this.added) panel.onState?.(state);
    this.rewind.follow(state.at);
    this.show(state);
  }

  onFrame(frame: Frame): void {
    const text = `${frame.time.toFixed(3)} s`;
    if (this.clock.textContent !== text) this.clock.textContent = text;
  }

  draw(): void {
    this.rewind.tick();
    if (this.page.state) this.show(this.page.state);
  }

  // While the past is seen, what is remembered is played again.
  toggle(): void {
    const { state } = this.page;
    if (!state) return;
    const { rewind } = this;
    if (rewind.at === null) this.page.send({ do: 'play', on: !state.playing });
    else if (rewind.playing) rewind.pause();
    else rewind.play(rewind.at, state.speed);
  }

  askBranch(): void {
    const { state } = this.page;
    if (state) this.dialog.ask(this.rewind.at ?? state.last);
  }

  private single(): void {
    const { state } = this.page;
    if (!state) return;
    if (this.rewind.at === null) this.page.send({ do: 'step', steps: 1 });
    else this.rewind.seek(Math.min(state.last, this.rewind.at + 1 / 60));
  }

  private scrub(): void {
    const { slider } = this;
    slider.addEventListener('pointerdown', () => (this.scrubbing = true));
    for (const end of ['pointerup', 'pointercancel', 'change', 'blur'])
      slider.addEventListener(end, () => (this.scrubbing = false));
    slider.addEventListener('input', () => this.seek(Number(slider.value) / PLACES));
    slider.addEventListener('keydown', (event) => {
      const way = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
      const { state } = this.page;
      if (!way || !state) return;
      const by = event.shiftKey ? 0.5 : 1 / 60;
      this.seekTime((this.rewind.at ?? state.last) + way * by);
      event.preventDefault();
      event.stopPropagation();
    });
  }

  private seek(share: number): void {
    const { state } = this.page;
    if (state) this.seekTime(state.first + share * (state.last - state.first));
  }

  // The present is at the end. A run that goes on stands first: an instant that moves away under
  // the pointer cannot be found.
  private seekTime(time: number): void {
    const { state, holds } = this.page;
    if (!state) return;
    const isNow = time >= state.last - 0.0005 * (state.last - state.first);
    if (!isNow && state.playing && holds) this.page.send({ do: 'play', on: false });
    this.rewind.seek(isNow ? null : Math.max(state.first, time));
  }

  private show(state: StateMessage): void {
    const { first, last, branch, dead } = state;
    const { at } = this.rewind;
    const goes = at === null ? state.playing && !dead : this.rewind.playing;
    const isWatching = watches(state);
    const pace = state.pace > 0 ? state.pace : 1;
    const wanted = [goes, first, last, branch?.number, dead?.time, at, state.speed, isWatching];
    const text = [...wanted, pace.toFixed(2), this.scrubbing, state.building].join();
    if (text === this.shown) return;
    this.shown = text;
    const isPaused = this.play.dataset.goes !== String(goes);
    if (isPaused) {
      this.play.dataset.goes = String(goes);
      this.play.replaceChildren(icon(goes ? 'pause' : 'play'));
      this.play.title = goes ? 'stand (space)' : 'go on (space)';
      this.play.setAttribute('aria-label', this.play.title);
    }
    this.root.dataset.past = String(at !== null);
    if (this.speed.value !== String(state.speed)) this.showSpeed(state.speed);
    const span = Math.max(1e-9, last - first);
    const share = at === null ? 1 : Math.min(1, Math.max(0, (at - first) / span));
    if (!this.scrubbing) this.slider.value = String(PLACES * share);
    this.slider.style.setProperty('--share', `${100 * share}%`);
    this.slider.setAttribute('aria-valuetext', at === null ? 'now' : `${at.toFixed(3)} seconds`);
    this.mark(this.fork, branch ? (branch.from - first) / span : -1);
    if (branch)
      this.fork.title = `branch at ${branch.from.toFixed(3)} s: ${branch.changes.join(', ')}`;
    this.mark(this.end, dead ? (dead.time - first) / span : -1);
    this.present.disabled = at === null;
    this.play.disabled = at === null && (isWatching || dead !== null);
    this.step.disabled = isWatching || (at === null && dead !== null);
    this.again.disabled = this.speed.disabled = this.branch.disabled = isWatching;
    this.where.replaceChildren(...this.words(state, at, pace));
  }

  private words(state: StateMessage, at: number | null, pace: number): (Node | string)[] {
    if (state.building) return [element('b', {}, `${state.building} …`)];
    if (at !== null) return [`${(state.last - at).toFixed(2)} s ago`];
    if (state.dead) return ['stopped'];
    if (!state.playing) return ['stands'];
    const lags = Math.abs(pace - 1) > REAL_TIME;
    const speed = state.speed === 1 ? 'real time' : `${speedText(state.speed)}× slow`;
    const words = state.speed > 1 ? `${state.speed}× fast` : speed;
    if (!lags) return [words];
    const title = 'run time over the time that it should take: the machine does not keep up';
    const badge = element('b', { class: 'pace', title }, `pace ${pace.toFixed(2)}`);
    return state.speed === 1 ? [badge] : [`${words}, `, badge];
  }

  private showSpeed(speed: number): void {
    const known = SPEEDS.find((one) => Math.abs(one - speed) < 1e-9);
    const other = this.speed.querySelector('.other');
    other?.remove();
    if (known === undefined)
      this.speed.append(
        element('option', { class: 'other', value: String(speed) }, `${speed}×`),
      );
    this.speed.value = String(known ?? speed);
  }

  private mark(mark: HTMLElement, share: number): void {
    mark.hidden = share < 0 || share > 1;
    mark.style.setProperty('--place', String(share));
  }
}

function speedText(speed: number): string {
  const at = SPEEDS.indexOf(speed);
  return at < 0 ? String(speed) : SPEED_WORDS[at];
}
