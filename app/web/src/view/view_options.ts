// Overlay switches, legend, and views of the camera.
import { button, changeDetector, element, icon, option } from '../ui/dom';
import type { SceneBody, SceneLayer } from '../source/link';
import { remember, remembered } from '../ui/preferences';
import type { ViewName } from './stage';

export class Overlays {
  private readonly lines = element('ul', { 'aria-label': 'legend' });
  readonly legend = element('details.legend', element('summary', 'Legend'), this.lines);
  private readonly list = element('div.switches', { role: 'group', 'aria-label': 'overlays', hidden: '' });
  private readonly toggle = button([icon('layers'), ' Show'], 'overlays (o)', () => this.fold(!this.folded));
  readonly root = element('div.corner', element('div.overlays', this.toggle, this.list), this.legend);
  private readonly areNew = changeDetector(); // layer names
  private layers: SceneLayer[] = [];

  // `shown`: layer names, also of other scenes. `hasNumbers`: keys 1 to 9 toggle them.
  constructor(
    private readonly shown: Set<string>,
    private readonly changed: () => void,
    readonly hasNumbers = true,
  ) {
    this.fold(true);
    this.legend.open = remembered('legend', true);
    this.legend.addEventListener('toggle', () => remember('legend', this.legend.open));
  }

  get names(): string[] {
    return ['bodies', ...this.shown];
  }
  isShown(name: string): boolean {
    return name === 'bodies' || this.shown.has(name);
  }

  fold(folded: boolean): void {
    if (folded && this.list.contains(document.activeElement)) this.toggle.focus();
    this.list.hidden = folded;
    this.toggle.setAttribute('aria-expanded', String(!folded));
  }
  get folded(): boolean {
    return this.list.hidden;
  }

  show(layers: SceneLayer[]): void {
    this.layers = layers;
    const overlays = layers.filter(({ name }) => name !== 'bodies');
    if (this.areNew(overlays.map(({ name }) => name)))
      this.list.replaceChildren(...overlays.map((layer, i) => this.line(layer, i + 1)));
    this.showLegend();
  }

  set(name: string, shown: boolean): void {
    if (this.shown.has(name) !== shown) this.list.querySelector<HTMLElement>(`[data-layer="${name}"]`)?.click();
  }

  toggleNumber(number: number): void {
    this.list.querySelectorAll('input')[number - 1]?.click();
  }

  private line({ name, what }: SceneLayer, number: number): HTMLElement {
    const box = element('input', { type: 'checkbox', 'data-layer': name });
    box.checked = this.shown.has(name);
    box.addEventListener('change', () => {
      if (box.checked) this.shown.add(name);
      else this.shown.delete(name);
      this.showLegend();
      this.changed();
    });
    const key = this.hasNumbers && number < 10 ? [element('kbd', String(number))] : [];
    return element('label', { title: what }, box, element('span', name), ...key);
  }

  // Legends change during a run: scales of arrows grow.
  private showLegend(): void {
    const lines = this.layers.filter(({ name }) => this.isShown(name)).flatMap(({ legend }) => legend);
    const items = lines.map(({ color, bar, text }) => {
      const swatch = element('i');
      const colors = (bar ?? [color, color]).map((one) => `rgb(${one.join(' ')})`);
      swatch.style.background = `linear-gradient(to right, ${colors.join(', ')})`;
      return element('li', swatch, text);
    });
    this.lines.replaceChildren(...items);
    this.legend.hidden = lines.length === 0;
  }
}

const NAMES: ViewName[] = ['start', 'front', 'side', 'top', 'iso'];

// View directions, and the body that the camera follows.
export class Views {
  readonly root = element('div.views');
  private readonly follows = element('select', { title: 'body to follow (f)', 'aria-label': 'camera' });
  private readonly areNew = changeDetector(); // bodies

  constructor(look: (name: ViewName) => void, private readonly changed: () => void) {
    const views = NAMES.map((name) => {
      const [label, title] = name === 'start' ? ['fit', 'reset the view (r)'] : [name, `${name} view (v)`];
      return button(label, title, () => look(name));
    });
    this.root.append(...views, this.follows);
    this.follows.hidden = true; // until the bodies are known
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
    if (!this.areNew(moving)) return;
    this.follows.hidden = false;
    const others = moving.map(({ name, i }) => option(i, `follow ${name}`));
    this.follows.replaceChildren(option('', 'camera: free'), ...others);
  }

  // The selected body, else the next one; then free again.
  next(selected: number | null): void {
    if (selected !== null && this.body !== selected) this.body = selected;
    else {
      this.follows.selectedIndex = (this.follows.selectedIndex + 1) % this.follows.length;
      this.changed();
    }
  }
}
