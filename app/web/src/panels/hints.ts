// What stands in words over the view: what to look for, what the pointer would do, and whether the
// lab is there.
import './hints.css';
import { bullets, button, element } from '../ui/dom';
import type { SceneMessage } from '../source/link';

const STAYS = 4000; // [ms]
const LOST = 'The connection is lost. It is tried again; what the lab remembers stays.';
const PATIENCE = 500; // before a lost connection is spoken of

export class Hints {
  readonly look = element('section.look', { hidden: '', 'aria-label': 'what to look for' });
  // Brings it back.
  readonly again = button('What to look for', 'what this scene shows', () => this.fold(false));
  readonly hint = element('p.hint-line');
  readonly spoken = element('p.unseen', { role: 'status' }); // what is said, for ears
  private readonly lost = element('span');
  readonly banner = element('div.banner', { role: 'status', hidden: '' }, element('i'), this.lost);
  private said = '';
  private until = 0;
  private shown = '';
  private file = '';
  private count = 0; // lines of what to look for
  private lostAt: number | null = 0;

  constructor() {
    this.again.hidden = true;
  }

  show(scene: SceneMessage): void {
    if (scene.file === this.file) return;
    this.file = scene.file;
    this.count = scene.look.length;
    this.look.hidden = this.count === 0;
    this.again.hidden = true;
    this.look.replaceChildren(
      element('h2', 'What to look for'),
      button('×', 'away', () => this.fold(true), 'close'),
      bullets(scene.look),
    );
  }

  // Who has turned to the robot has read it.
  fold(away: boolean): void {
    if (this.file === '' || this.count === 0) return;
    const at = document.activeElement;
    this.look.hidden = away;
    this.again.hidden = !away;
    if (away && this.look.contains(at)) this.again.focus();
    if (!away && at === this.again) this.look.querySelector('button')!.focus();
  }

  say(words: string): void {
    this.said = this.spoken.textContent = words;
    this.until = performance.now() + STAYS;
  }

  connection(open: boolean): void {
    this.lostAt = open ? null : (this.lostAt ?? performance.now());
  }

  // Once a picture.
  tick(now: number, hint: string): void {
    const words = now < this.until ? this.said : hint;
    if (words !== this.shown) this.hint.textContent = this.shown = words;
    const isLost = this.lostAt !== null && now - this.lostAt > PATIENCE;
    if (this.banner.hidden !== isLost) return;
    this.banner.hidden = !isLost;
    this.lost.textContent = this.lostAt === 0 ? 'Waiting for the lab ..' : LOST;
  }
}
