// The time bar of a run that goes on: single steps, going back, branches, files.
import { button, changeDetector, element, icon } from '../ui/dom';
import { BranchDialog } from './branch_dialog';
import { type Frame, type StateMessage, watches } from '../source/link';
import type { LabPage, Panel } from './panel';
import { Rewind } from '../source/playhead';
import { SaveMenu } from './menus';
import { putMark } from '../ui/slider';
import { type Clock, speedText, TimeBar } from './time_bar';

const REAL_TIME = 0.015; // nearer to 1 is real time
const STEP = 1 / 60; // of arrows [s]
const BRANCH = 'go on from this instant, with other knobs';
const LABEL = 'instant of the run, back over what is remembered';

export class LabTimeBar implements Panel, Clock {
  readonly rewind = new Rewind(this.page);
  private readonly step = button(icon('step'), 'one step', () => this.single());
  private readonly reset = () => this.page.send({ do: 'reset' });
  private readonly again = button(icon('again'), 'to the start: the run begins anew', this.reset);
  private readonly branch = button('branch …', BRANCH, () => this.askBranch());
  private readonly present = button('to now', 'to the newest instant', () => this.rewind.look(null));
  private readonly fork = element('i.fork', { 'aria-hidden': 'true' });
  private readonly end = element('i.end', { 'aria-hidden': 'true' });
  private readonly bar = new TimeBar(this, LABEL, [], [this.step, this.again]);
  private readonly dialog = new BranchDialog(this.page, this.rewind, this.changes);
  readonly root = this.bar.root;
  private readonly added: Panel[] = [];
  private time: number | null = null; // of the newest frame
  private readonly isNew = changeDetector();

  constructor(private readonly page: LabPage, private readonly changes: () => string[]) {
    this.root.append(this.dialog.root);
    this.bar.slider.root.append(this.fork, this.end);
    this.bar.ends.append(this.branch, this.present, new SaveMenu().root);
    this.bar.slider.input.addEventListener('keydown', (event) => {
      const way = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
      const { state } = page;
      if (!way || !state) return;
      this.seek((this.rewind.at ?? state.last) + way * (event.shiftKey ? 0.5 : STEP));
      event.preventDefault();
      event.stopPropagation();
    });
  }

  // Stands at the end of the bar, and hears what the lab says.
  add(panel: Panel): void {
    this.added.push(panel);
    this.bar.ends.append(panel.root);
  }

  get speed(): number {
    return this.page.state?.speed ?? 1;
  }
  setSpeed(factor: number): void {
    this.page.send({ do: 'speed', factor });
  }

  onState(state: StateMessage): void {
    for (const panel of this.added) panel.onState?.(state);
    this.rewind.follow(state.at);
  }

  onFrame(frame: Frame): void {
    this.time = frame.time;
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

  seekShare(share: number): void {
    const { state } = this.page;
    if (state) this.seek(state.first + share * (state.last - state.first));
  }

  // The present is at the end. A run that goes on stands first: an instant that moves away under
  // the pointer cannot be found.
  seek(time: number): void {
    const { state, holds } = this.page;
    if (!state) return;
    const isNow = time >= state.last - 0.0005 * (state.last - state.first);
    if (!isNow && state.playing && holds) this.page.send({ do: 'play', on: false });
    this.rewind.look(isNow ? null : Math.max(state.first, time));
  }

  private single(): void {
    const { state } = this.page;
    if (!state) return;
    if (this.rewind.at === null) this.page.send({ do: 'step', steps: 1 });
    else this.rewind.look(Math.min(state.last, this.rewind.at + STEP));
  }

  private show(state: StateMessage): void {
    const { first, last, branch, dead, speed } = state;
    const { at } = this.rewind;
    const goes = at === null ? state.playing && !dead : this.rewind.playing;
    const span = Math.max(1e-9, last - first);
    const share = at === null ? 1 : Math.min(1, Math.max(0, (at - first) / span));
    const words = at === null ? 'now' : `${at.toFixed(3)} seconds`;
    this.bar.show({ time: this.time, share, goes, speed, words });
    const isWatching = watches(state);
    const pace = state.pace > 0 ? state.pace : 1;
    const shown = [goes, first, last, branch, dead?.time, at, speed, isWatching, pace.toFixed(2)];
    if (!this.isNew(shown, state.building)) return;
    this.root.dataset.past = String(at !== null);
    putMark(this.fork, branch && (branch.from - first) / span);
    if (branch) this.fork.title = `branch at ${branch.from.toFixed(3)} s: ${branch.changes.join(', ')}`;
    putMark(this.end, dead && (dead.time - first) / span);
    this.present.disabled = at === null;
    this.bar.play.disabled = at === null && (isWatching || dead !== null);
    this.step.disabled = isWatching || (at === null && dead !== null);
    this.again.disabled = this.bar.speed.disabled = this.branch.disabled = isWatching;
    this.bar.where.replaceChildren(...this.words(state, at, pace));
  }

  private words(state: StateMessage, at: number | null, pace: number): (Node | string)[] {
    if (state.building) return [element('b', `${state.building} …`)];
    if (at !== null) return [`${(state.last - at).toFixed(2)} s ago`];
    if (state.dead) return ['stopped'];
    if (!state.playing) return ['stands'];
    const lags = Math.abs(pace - 1) > REAL_TIME;
    const speed = state.speed === 1 ? 'real time' : `${speedText(state.speed)}× slow`;
    const words = state.speed > 1 ? `${state.speed}× fast` : speed;
    if (!lags) return [words];
    const title = 'run time over the time that it should take: the machine does not keep up';
    const badge = element('b.pace', { title }, `pace ${pace.toFixed(2)}`);
    return state.speed === 1 ? [badge] : [`${words}, `, badge];
  }
}
