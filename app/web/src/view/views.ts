// From where the robot is seen, and what the camera goes along with.
import { button, element } from '../ui/dom';
import type { ViewName } from './stage';
import type { SceneBody } from '../source/link';

const NAMES: [ViewName, string][] = [
  ['start', 'fit'],
  ['front', 'front'],
  ['side', 'side'],
  ['top', 'top'],
  ['iso', 'iso'],
];

export class Views {
  readonly root = element('div.views');
  private readonly follows = element('select', { title: 'what the camera follows (f)', 'aria-label': 'camera' });
  private known = '';

  constructor(
    look: (name: ViewName) => void,
    private readonly changed: () => void,
  ) {
    for (const [name, words] of NAMES)
      this.root.append(button(words, name === 'start' ? 'all in view (r)' : `from: ${name} (v)`, () => look(name)));
    this.root.append(this.follows);
    this.follows.hidden = true; // until it is known what it may follow
    this.follows.addEventListener('change', changed);
  }

  get body(): number | null {
    return this.follows.value === '' ? null : Number(this.follows.value);
  }
  set body(body: number | null) {
    this.follows.value = body === null ? '' : String(body);
    this.changed();
  }

  show(bodies: Pick<SceneBody, 'name' | 'moves'>[]): void {
    const moving = bodies.flatMap(({ name, moves }, i) => (moves ? [{ name, i }] : []));
    const known = JSON.stringify(moving);
    if (known === this.known) return;
    this.known = known;
    this.follows.hidden = false;
    this.follows.replaceChildren(
      element('option', { value: '' }, 'camera: free'),
      ...moving.map(({ name, i }) => element('option', { value: String(i) }, `on ${name}`)),
    );
  }

  // The selected one, else the next; then free again.
  next(selected: number | null): void {
    if (selected !== null && this.body !== selected) this.body = selected;
    else {
      this.follows.selectedIndex = (this.follows.selectedIndex + 1) % this.follows.length;
      this.changed();
    }
  }
}
