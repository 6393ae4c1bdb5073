// Which overlays are shown: chosen once, kept for all scenes, and told to the lab, which sends no
// others. Folded away until wanted: there are many of them.
import { button, element, icon } from '../ui/dom';
import { LayerChoice } from './layers';
import type { SceneMessage } from '../source/link';
import { remember, remembered } from '../ui/memory';

const AT_FIRST = ['ghost', 'device', 'couplings', 'contacts', 'felt', 'before'];
type Head = SceneMessage['layers'][number] & { shown: boolean };

export class Overlays {
  readonly root = element('div.overlays');
  readonly legend = element('div');
  private choice: LayerChoice<Head> | null = null;
  private chosen = new Set(remembered<string[]>('layers', AT_FIRST));
  private readonly toggle: HTMLButtonElement;
  private readonly list = element('div.list', { hidden: '' });
  private known = ''; // names of layers
  private heads: Head[] = [];

  constructor(private readonly changed: () => void) {
    this.toggle = button(icon('layers'), 'what is shown (o)', () => this.fold(!this.list.hidden));
    this.toggle.append(' Show');
    this.toggle.setAttribute('aria-expanded', 'false');
    this.root.append(this.toggle, this.list);
  }

  get names(): string[] {
    return ['bodies', ...this.chosen];
  }
  get shown(): Set<string> {
    return this.chosen;
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
    const known = JSON.stringify(scene.layers.map(({ name }) => name));
    if (known === this.known) {
      // What the colours mean changes on the way: scales of arrows grow.
      scene.layers.forEach(({ legend }, l) => (this.heads[l].legend = legend));
      this.choice?.fillLegend();
      return;
    }
    this.known = known;
    const heads = scene.layers.map((layer) => ({ ...layer, shown: this.chosen.has(layer.name) }));
    this.heads = heads;
    this.choice = new LayerChoice<Head>(heads, () => this.take(heads));
    this.list.replaceChildren(this.choice.switches);
    this.legend.replaceChildren(this.choice.legend);
  }

  toggleNumber(number: number): void {
    this.choice?.toggleNumber(number);
  }

  // Those of other scenes stay chosen.
  private take(heads: Head[]): void {
    for (const { name, shown } of heads)
      if (shown) this.chosen.add(name);
      else this.chosen.delete(name);
    this.chosen.delete('bodies');
    remember('layers', [...this.chosen]);
    this.changed();
  }
}
