// Time bar of a live run: single steps, earlier instants, branches, files.
import { button, changeDetector, element, icon } from '../ui/dom';
import { BranchDialog } from './branch_dialog';
import { isViewOnly, type StateMessage } from '../source/link';
import type { LabPage, Panel } from './panel';
import { Rewind } from '../source/playhead';
import { saveMenu } from './menus';
import { putMark } from '../ui/slider';
import { type Clock, speedText, TimeBar } from './time_bar';

const REAL_TIME = 0.015; // tolerance of the real-time factor
const STEP = 1 / 60; // of arrow keys [s]
const BRANCH = 'continue from this instant with changed parameters';
const LABEL = 'instant of the buffered run';

export class LabTimeBar implements Panel, Clock {
  readonly rewind = new Rewind(this.page);
  private readonly step = button(icon('step'), 'one step', () => this.single());
  private readonly again = button(icon('again'), 'restart', () => this.page.send({ do: 'reset' }));
  private readonly branch = button('branch …', BRANCH, () => this.openBranch());
  private readonly present = button('to now', 'to the newest instant', () => this.rewind.look(null));
  private readonly branchMark = element('i.branch-mark', { 'aria-hidden': 'true' });
  private readonly end = element('i.end', { 'aria-hidden': 'true' });
  private readonly bar = new TimeBar(this, LABEL, [], [this.step, this.again]);
  private readonly dialog = new BranchDialog(this.page, this.rewind, this.changes);
  readonly root = this.bar.root;
  private readonly isNew = changeDetector();

  // `menus`: at the end of the bar.
  constructor(private readonly page: LabPage, private readonly changes: () => string[], menus: Node[]) {
    this.root.append(this.dialog.root);
    this.bar.slider.root.append(this.branchMark, this.end);
    this.bar.ends.append(this.branch, this.present, saveMenu(), ...menus);
    this.bar.slider.input.addEventListener('keydown', (event) => {
      const way = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
      if (!way) return;
      this.seekBy(way, event.shiftKey);
      event.preventDefault();
      event.stopPropagation();
    });
  }

  get speed(): number {
    return this.page.state?.speed ?? 1;
  }
  setSpeed(factor: number): void {
    this.page.send({ do: 'speed', factor });
  }

  onState(state: StateMessage): void {
    this.rewind.follow(state.at);
  }

  draw(): void {
    this.rewind.tick();
    if (this.page.state) this.show(this.page.state);
  }

  // Plays or pauses the run, or the playback of the buffer while an earlier instant is shown.
  toggle(): void {
    const { state } = this.page;
    if (!state) return;
    const { rewind } = this;
    if (rewind.at === null) this.page.send({ do: 'play', on: !state.playing });
    else if (rewind.playing) rewind.playing = false;
    else rewind.play(rewind.at, state.speed);
  }

  openBranch(): void {
    const { state } = this.page;
    if (state) this.dialog.open(this.rewind.at ?? state.last);
  }

  seekShare(share: number): void {
    const { state } = this.page;
    if (state) this.seek(state.first + share * (state.last - state.first));
  }

  // The end is the present. Seeking pauses the run, or the instant would move relative to the slider.
  seek(time: number): void {
    const { state, operator } = this.page;
    if (!state) return;
    const isNow = time >= state.last - 0.0005 * (state.last - state.first);
    if (!isNow && state.playing && operator.hasControl) this.page.send({ do: 'play', on: false });
    this.rewind.look(isNow ? null : Math.max(state.first, time));
  }

  // By an arrow key: -1 or 1.
  seekBy(way: number, isCoarse: boolean): void {
    const { state } = this.page;
    if (state) this.seek((this.rewind.at ?? state.last) + way * (isCoarse ? 0.5 : STEP));
  }

  private single(): void {
    const { state } = this.page;
    if (!state) return;
    if (this.rewind.at === null) this.page.send({ do: 'step', steps: 1 });
    else this.rewind.look(Math.min(state.last, this.rewind.at + STEP));
  }

  private show(state: StateMessage): void {
    const { first, last, branch, failure, speed } = state;
    const { at } = this.rewind;
    const isPlaying = at === null ? state.playing && !failure : this.rewind.playing;
    const span = Math.max(1e-9, last - first);
    const share = at === null ? 1 : Math.min(1, Math.max(0, (at - first) / span));
    const words = at === null ? 'now' : `${at.toFixed(3)} seconds`;
    this.bar.show({ time: this.page.frame?.time ?? null, share, isPlaying, speed, words });
    const isDisabled = isViewOnly(state);
    const pace = state.speed_ratio > 0 ? state.speed_ratio : 1;
    const shown = [isPlaying, first, last, branch, failure?.time, at, speed, isDisabled, pace.toFixed(2)];
    if (!this.isNew(shown)) return;
    this.root.dataset.past = String(at !== null);
    putMark(this.branchMark, branch && (branch.from - first) / span);
    if (branch) this.branchMark.title = `branch at ${branch.from.toFixed(3)} s: ${branch.changes.join(', ')}`;
    putMark(this.end, failure && (failure.time - first) / span);
    this.present.disabled = isDisabled || at === null;
    this.bar.play.disabled = isDisabled || (at === null && failure !== null);
    this.step.disabled = isDisabled || (at === null && failure !== null);
    this.again.disabled = this.bar.speed.disabled = this.branch.disabled = isDisabled;
    this.bar.slider.input.disabled = isDisabled;
    this.bar.where.replaceChildren(...this.status(state, at, pace));
  }

  private status({ last, failure, playing, speed }: StateMessage, at: number | null, pace: number) {
    if (at !== null) return [`${(last - at).toFixed(2)} s ago`];
    if (failure) return ['diverged'];
    if (!playing) return ['paused'];
    const text = speed === 1 ? 'real time' : `${speedText(speed)}× ${speed > 1 ? 'fast' : 'slow'}`;
    if (Math.abs(pace - 1) <= REAL_TIME) return [text];
    const title = 'achieved speed relative to the speed that is set: the computer is too slow';
    const badge = element('b.pace', { title }, `${(100 * pace).toFixed(0)} % speed`);
    return [badge];
  }
}
