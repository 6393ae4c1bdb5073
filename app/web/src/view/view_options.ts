// Overlay switches, legend, and views of the camera.
import type { Layer } from '../protocol/run';
import { button, changeDetector, element, icon, option } from '../ui/dom';
import type { SceneBody, SceneMessage } from '../source/link';
import { remember, remembered } from '../ui/preferences';
import type { ViewName } from './stage';

type LayerHead = Pick<Layer, 'name' | 'what' | 'shown' | 'legend'>;

export class LayerChoice<L extends LayerHead = Layer> {
  readonly switches = element('fieldset.switches', element('legend', 'Show'));
  readonly legend = element('ul.legend', { 'aria-label': 'legend' });
  private readonly boxes = new Map<string, HTMLInputElement>();

  constructor(private readonly layers: L[], private readonly changed: () => void) {
    // Bodies are always shown; a layer without entries gets no switch.
    const choice = layers.filter((layer) => layer.name !== 'bodies' && mayHaveEntries(layer));
    choice.forEach((layer, i) => this.addSwitch(layer, i < 9 ? String(i + 1) : ''));
    this.fillLegend();
  }

  get shown(): L[] {
    return this.layers.filter((layer) => layer.name === 'bodies' || layer.shown);
  }

  set(name: string, shown: boolean): void {
    const layer = this.layers.find((l) => l.name === name);
    const box = this.boxes.get(name);
    if (!layer || !box) return;
    layer.shown = box.checked = shown;
    this.fillLegend();
    this.changed();
  }

  toggleNumber(number: number): void {
    const name = [...this.boxes.keys()][number - 1];
    if (name) this.set(name, !this.boxes.get(name)!.checked);
  }

  private addSwitch(layer: LayerHead, key: string): void {
    const box = element('input', { type: 'checkbox', 'data-layer': layer.name });
    box.checked = layer.shown;
    box.addEventListener('change', () => this.set(layer.name, box.checked));
    this.boxes.set(layer.name, box);
    const words = element('span', layer.name);
    const label = element('label', { title: layer.what }, box, words);
    if (key) label.append(element('kbd', key));
    this.switches.append(label);
  }

  fillLegend(): void {
    this.legend.replaceChildren();
    for (const layer of this.shown)
      for (const line of layer.legend) {
        const swatch = element('i');
        swatch.style.background = `rgb(${line.color.join(' ')})`;
        this.legend.append(element('li', swatch, line.text));
      }
    this.legend.hidden = this.legend.childElementCount === 0;
  }
}

// True for layers of a live run.
function mayHaveEntries(layer: LayerHead): boolean {
  const { instances, labels } = layer as Partial<Layer>;
  if (!instances || !labels) return true;
  return instances.mesh.length > 0 || labels.text.length > 0;
}

const DEFAULT_LAYERS = ['ghost', 'device', 'couplings', 'contacts', 'felt', 'before'];
type Head = SceneMessage['layers'][number] & { shown: boolean };

// Overlays of the lab: the choice holds for all scenes; the lab sends only the chosen layers.
export class Overlays {
  readonly root = element('div.overlays');
  readonly legend = element('div');
  readonly shown = new Set(remembered<string[]>('layers', DEFAULT_LAYERS)); // of other scenes too
  private choice: LayerChoice<Head> | null = null;
  private readonly toggle: HTMLButtonElement;
  private readonly list = element('div.list', { hidden: '' });
  private readonly areNew = changeDetector(); // layer names
  private heads: Head[] = [];

  constructor(private readonly changed: () => void) {
    this.toggle = button(icon('layers'), 'overlays (o)', () => this.fold(!this.list.hidden));
    this.toggle.append(' Show');
    this.toggle.setAttribute('aria-expanded', 'false');
    this.root.append(this.toggle, this.list);
  }

  get names(): string[] {
    return ['bodies', ...this.shown];
  }

  fold(folded: boolean): void {
    if (folded && this.list.contains(document.activeElement)) this.toggle.focus();
    this.list.hidden = folded;
    this.toggle.setAttribute('aria-expanded', String(!folded));
  }
  get folded(): boolean {
    return this.list.hidden;
  }

  show(scene: SceneMessage): void {
    if (!this.areNew(scene.layers.map(({ name }) => name))) {
      // Legends change during a run: scales of arrows grow.
      scene.layers.forEach(({ legend }, l) => (this.heads[l].legend = legend));
      this.choice?.fillLegend();
      return;
    }
    this.heads = scene.layers.map((layer) => ({ ...layer, shown: this.shown.has(layer.name) }));
    this.choice = new LayerChoice<Head>(this.heads, () => this.take());
    this.list.replaceChildren(this.choice.switches);
    this.legend.replaceChildren(this.choice.legend);
  }

  toggleNumber(number: number): void {
    this.choice?.toggleNumber(number);
  }

  private take(): void {
    for (const { name, shown } of this.heads)
      if (shown) this.shown.add(name);
      else this.shown.delete(name);
    this.shown.delete('bodies');
    remember('layers', [...this.shown]);
    this.changed();
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
