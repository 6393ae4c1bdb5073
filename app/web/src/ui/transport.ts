// Play, step, scrub, speed.
import { button, element, icon } from './dom';
import { SPEEDS, type Player } from './player';

export class Transport {
  readonly root: HTMLElement;
  private readonly play: HTMLButtonElement;
  private readonly slider: HTMLInputElement;
  private readonly clock = element('output', { class: 'clock', 'aria-live': 'off' });
  private readonly frame = element('output', { class: 'frame' });
  private readonly speed: HTMLSelectElement;
  private playing = false; // as the button shows

  constructor(private readonly player: Player) {
    const { start, end } = player;
    this.play = button(icon('play'), 'play or pause (space)', () => player.toggle(), 'play');
    this.slider = element('input', {
      type: 'range',
      min: String(start),
      max: String(end),
      step: 'any',
      'aria-label': 'time in seconds',
    });
    this.slider.addEventListener('input', () => {
      player.playing = false;
      player.seek(Number(this.slider.value));
    });
    this.speed = element('select', { title: 'speed: [ slower, ] faster', 'aria-label': 'speed' });
    for (const speed of SPEEDS)
      this.speed.append(element('option', { value: String(speed) }, `${speed}×`));
    this.speed.addEventListener('change', () => player.setSpeed(Number(this.speed.value)));
    this.root = element(
      'footer',
      { class: 'transport' },
      button(icon('first'), 'to the start (Home)', () => player.seek(start)),
      button(icon('back'), 'one frame back (←)', () => player.step(-1)),
      this.play,
      button(icon('on'), 'one frame on (→)', () => player.step(1)),
      button(icon('last'), 'to the end (End)', () => player.seek(end)),
      this.slider,
      this.clock,
      this.frame,
      this.speed,
    );
    player.watch(() => this.show());
    this.show();
  }

  private show(): void {
    const { player } = this;
    const share = (player.time - player.start) / Math.max(1e-12, player.end - player.start);
    if (this.playing !== player.playing) {
      this.playing = player.playing;
      this.play.replaceChildren(icon(player.playing ? 'pause' : 'play'));
    }
    this.slider.value = String(player.time);
    this.slider.style.setProperty('--share', `${100 * share}%`);
    this.clock.textContent = `${player.time.toFixed(3)} s`;
    this.frame.textContent = `frame ${player.frame + 1} of ${player.times.length}`;
    this.speed.value = String(player.speed);
  }
}
