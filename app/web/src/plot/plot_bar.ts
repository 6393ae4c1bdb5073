// Above the plots: of a run that goes on how much time they show and whether they stand; their file.
import { button, element, icon } from '../ui/dom';
import { Segments } from '../ui/segments';

export interface PlotBarUser {
  paused(on: boolean): void;
  all(): void;
  degrees(on: boolean): void;
  saveCsv(): void;
}

const LENGTHS: Record<string, number> = { '10 s': 10, '30 s': 30, all: Infinity };

export class PlotBar {
  readonly root = element('div.plot-bar', { role: 'toolbar', 'aria-label': 'plots' });
  length: number; // of the time shown [s]
  private readonly pause: HTMLButtonElement;
  private paused = false;

  constructor(isLive: boolean, user: PlotBarUser) {
    this.length = LENGTHS[isLive ? '10 s' : 'all'];
    const lengths = new Segments('time shown', Object.keys(LENGTHS), (name) => {
      this.length = LENGTHS[name];
      user.all();
    });
    lengths.show('10 s');
    const angles = new Segments('angles in', ['°', 'rad'], (name) => user.degrees(name === '°'));
    angles.show('°');
    this.pause = button(
      icon('pause'),
      'let the plots stand, while the run goes on',
      () => {
        this.showPaused(!this.paused);
        user.paused(this.paused);
      },
      'pause',
    );
    this.root.append(
      ...(isLive ? [this.pause, lengths.root] : [button('whole run', 'all of the time (double click)', () => user.all())]),
      angles.root,
      element('span.space'),
      button('all CSV', 'every quantity that is remembered, as a file', () => user.saveCsv()),
    );
  }

  showPaused(on: boolean): void {
    this.paused = on;
    this.pause.setAttribute('aria-pressed', String(on));
    this.pause.replaceChildren(icon(on ? 'play' : 'pause'));
    this.pause.title = on ? 'on with the newest' : 'let the plots stand, while the run goes on';
    this.pause.setAttribute('aria-label', this.pause.title);
  }
}
