// Which layers are shown, and what their colours mean.
import type { Layer } from '../protocol/run';
import { element } from '../ui/dom';

type LayerHead = Pick<Layer, 'name' | 'what' | 'shown' | 'legend'>;

export class LayerChoice<L extends LayerHead = Layer> {
  readonly switches = element('fieldset.switches', element('legend', 'Show'));
  readonly legend = element('ul.legend', { 'aria-label': 'what the colours mean' });
  private readonly boxes = new Map<string, HTMLInputElement>();

  constructor(private readonly layers: L[], private readonly changed: () => void) {
    // The bodies themselves are always there; what never has an entry needs no switch.
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

  // After what the colours mean has changed.
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

// What is still to come has no columns yet.
function mayHaveEntries(layer: LayerHead): boolean {
  const { instances, labels } = layer as Partial<Layer>;
  if (!instances || !labels) return true;
  return instances.mesh.length > 0 || labels.text.length > 0;
}
