// Time bar below the view: play or pause, speed, instant shown.
import { button, element, icon, option, setText } from '../ui/dom';
import { Slider } from '../ui/slider';
import './time_bar.css';

const SPEEDS = [0.01, 0.1, 0.25, 0.5, 1, 2, 5, 10];
const SPEED_WORDS = ['1/100', '1/10', '1/4', '1/2', '1', '2', '5', '10'];

// Controlled by a bar and by its keys.
export interface Clock {
  readonly speed: number;
  toggle(): void;
  setSpeed(factor: number): void;
  seekShare(share: number): void; // of the run, 0 to 1
}

// By entries of SPEEDS.
export function changeSpeed(clock: Clock, places: number): void {
  const near = (speed: number) => Math.abs(speed - clock.speed);
  const nearest = SPEEDS.reduce((a, b) => (near(b) < near(a) ? b : a));
  const factor = SPEEDS[SPEEDS.indexOf(nearest) + places];
  if (factor) clock.setSpeed(factor);
}

export const speedText = (speed: number): string => SPEED_WORDS[SPEEDS.indexOf(speed)] ?? String(speed);

interface Shown {
  time: number | null; // null: unchanged
  share: number;
  isPlaying: boolean;
  speed: number;
  words: string; // position of the slider, for screen readers
}

export class TimeBar {
  readonly root = element('footer.transport', { 'aria-label': 'time' });
  readonly play: HTMLButtonElement;
  readonly slider: Slider;
  readonly speed = element('select', { title: 'speed: [ slower, ] faster', 'aria-label': 'speed' });
  readonly where = element('output.where.fine');
  readonly ends = element('div.buttons');
  private readonly clock = element('output.clock', { 'aria-live': 'off' });

  constructor(clock: Clock, sliderLabel: string, before: Node[], after: Node[]) {
    this.play = button(icon('play'), '', () => clock.toggle(), 'play');
    this.slider = new Slider(sliderLabel, (place) => clock.seekShare(place));
    this.speed.append(...SPEEDS.map((speed, i) => option(speed, `${SPEED_WORDS[i]}×`)));
    this.speed.addEventListener('change', () => clock.setSpeed(Number(this.speed.value)));
    this.root.append(
      this.slider.root,
      element(
        'div.row',
        element('div.buttons', ...before, this.play, ...after, this.speed),
        element('div.reading', this.clock, this.where),
        this.ends,
      ),
    );
  }

  show({ time, share, isPlaying, speed, words }: Shown): void {
    if (time !== null) setText(this.clock, `${time.toFixed(3)} s`);
    if (this.play.dataset.playing !== String(isPlaying)) {
      this.play.dataset.playing = String(isPlaying);
      this.play.replaceChildren(icon(isPlaying ? 'pause' : 'play'));
      this.play.title = isPlaying ? 'pause (space)' : 'play (space)';
      this.play.setAttribute('aria-label', this.play.title);
    }
    if (!this.slider.isHeld) this.slider.put(share);
    this.slider.fill(share, words);
    if (this.speed.value !== String(speed)) this.showSpeed(speed);
  }

  private showSpeed(speed: number): void {
    this.speed.querySelector('.other')?.remove();
    const known = SPEEDS.find((one) => Math.abs(one - speed) < 1e-9);
    if (known === undefined)
      this.speed.append(element('option.other', { value: String(speed) }, `${speed}×`));
    this.speed.value = String(known ?? speed);
  }
}
