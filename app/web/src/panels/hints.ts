// Texts over the view: what to look for, what the pointer does, messages, state of the connection.
import './hints.css';
import { bullets, button, element, setText } from '../ui/dom';
import type { SceneMessage } from '../source/link';

const SHOWN_FOR = 4000; // [ms]
const LOST = 'Connection lost, reconnecting. The run continues on the server.';
const PATIENCE = 500; // until a lost connection is shown [ms]

export class Hints {
  readonly look = element('section.look', { hidden: '', 'aria-label': 'what to look for' });
  readonly again = element(
    'button',
    { type: 'button', title: 'about this scene', hidden: '', click: () => this.fold(false) },
    'What to look for',
  );
  readonly hint = element('p.hint-line');
  readonly spoken = element('p.unseen', { role: 'status' }); // messages, for screen readers
  readonly banner = element('div.banner', { role: 'status', hidden: '' });
  private message = '';
  private until = 0;
  private scene = NaN; // its number
  private lostAt: number | null = 0;

  show({ scene, look }: SceneMessage): void {
    if (scene === this.scene) return;
    this.scene = scene;
    this.look.hidden = look.length === 0;
    this.again.hidden = true;
    this.look.replaceChildren(
      element('h2', 'What to look for'),
      button('×', 'close', () => this.fold(true), 'close'),
      bullets(look),
    );
  }

  fold(folded: boolean): void {
    if (this.look.hidden && this.again.hidden) return; // no text
    const at = document.activeElement;
    this.look.hidden = folded;
    this.again.hidden = !folded;
    if (folded && this.look.contains(at)) this.again.focus();
    if (!folded && at === this.again) this.look.querySelector('button')!.focus();
  }

  showMessage(text: string): void {
    this.message = this.spoken.textContent = text;
    this.until = performance.now() + SHOWN_FOR;
  }

  connection(open: boolean): void {
    this.lostAt = open ? null : (this.lostAt ?? performance.now());
  }

  // Once per picture.
  tick(now: number, hint: string): void {
    setText(this.hint, now < this.until ? this.message : hint);
    const isLost = this.lostAt !== null && now - this.lostAt > PATIENCE;
    if (this.banner.hidden !== isLost) return;
    this.banner.hidden = !isLost;
    this.banner.textContent = this.lostAt === 0 ? 'Connecting …' : LOST;
  }
}
